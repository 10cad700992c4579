// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SparseTsdf_h
#define novelview_SparseTsdf_h

#include "core/Execution.h"
#include "fusion/TsdfField.h"
#include "geometry/TriangleMesh.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace novelview
{
/**
 * A TsdfField sampled on a lattice of which only blocks near the surface are stored, and its
 * surface.
 *
 * The blocks around the seeds are evaluated first. Where the sign changes in a block or between it
 * and the next, all blocks around it follow, until the surface is closed. Parts of the surface that
 * no seed leads to are missing.
 */
class SparseTsdf
{
public:
  /**
   * `field` must outlive this; `spacing` is the distance of the lattice's points, world units.
   * Outside `bounds` everything is free.
   */
  SparseTsdf(const TsdfField& field, const Eigen::AlignedBox3d& bounds,
    const std::vector<Eigen::Vector3d>& seeds, double spacing, const Execution& execution);

  /**
   * Smooths the field f where the maps say little: lowers, by damped Jacobi iteration, the sum over
   * the points of
   *
   *     E = W (f - f0)^2 + lambda (Laplacian f)^2   with f >= d,
   *
   * f0 the field as sampled, W its weight, d the signed distance to the silhouettes. Surfaces
   * without curvature, and slowly curved ones, stay where they are.
   */
  void Smooth(double lambda, int iterations, const Execution& execution);

  /**
   * Makes points solid until the surface is a manifold: until no square of four points has solid
   * points in one diagonal and free points in the other, and no cube consists of two opposite
   * corners against the other six.
   *
   * Source: Latecki, "3D well-composed pictures", Graphical Models and Image Processing 59, 1997.
   */
  void MakeManifold(const Execution& execution);

  /**
   * The surface net: a point in every cell that the surface passes through, at the mean of its
   * crossings with the cell's edges; two triangles for every edge of the lattice that it crosses.
   * Closed and oriented outwards, and a manifold after MakeManifold().
   *
   * Source: Gibson, "Constrained elastic surface nets", MICCAI 1998, without the relaxation.
   */
  TriangleMesh Surface(const Execution& execution) const;

  int NumberOfBlocks() const { return static_cast<int>(this->Blocks.size()); }

private:
  static constexpr int Side = 4; ///< points along a side of a block
  static constexpr int Size = Side * Side * Side;

  struct Block
  {
    Eigen::Vector3i At;
    bool Crossed = false;           ///< whether the surface passes through it
    std::array<int, 27> Around;     ///< neighbours, x fastest; 13 = itself, -1 = not stored
    std::array<float, Size> Values; ///< signed distance, footprints, above 0 = free
    std::array<float, Size> Sampled;
    std::array<float, Size> Weights;
    std::array<float, Size> Outside;
  };

  /** A corner of a cell or block, 0 to 7. */
  static Eigen::Vector3i CornerOf(int corner)
  {
    return { corner & 1, corner >> 1 & 1, corner >> 2 };
  }
  static Eigen::Vector3i PointOf(int n) { return { n % Side, n / Side % Side, n / (Side * Side) }; }

  /** A point, given relative to a block's first, in the block that stores it. */
  struct Place
  {
    int Block; ///< -1 = not stored
    int Point;
  };
  Place Find(int block, const Eigen::Vector3i& at) const;

  void Add(const Eigen::Vector3i& block);
  /** Evaluates blocks from `done` on, and adds those around crossed ones until there are no more. */
  void Grow(std::size_t done, const Execution& execution);
  void Sample(Block& block) const;
  bool Crosses(const Block& block) const;
  /** The values at the corners of the cell at a point, x fastest; false when one is not stored. */
  bool Cell(int block, int point, std::array<float, 8>& values) const;
  using Values = std::vector<std::array<float, Size>>; ///< of all blocks
  /** Sums over the six neighbours of their differences to each point of a block. */
  void Laplacian(const Values& values, int block, std::array<float, Size>& sums) const;
  /** The corners (a bit each) of the cell that are to become solid. */
  int CornersToFill(int block, int point) const;
  /** Points of a block's cells, and per point of the block the number of its cell's, -1 = none. */
  void SampleCells(
    int block, std::vector<Eigen::Vector3d>& points, std::array<int, Size>& numbers) const;
  void AddTriangles(
    int block, const std::vector<std::array<int, Size>>& numbers, TriangleMesh& mesh) const;

  const TsdfField& Field;
  Eigen::AlignedBox3d Bounds;
  Eigen::Vector3d Origin;
  double Spacing;
  std::vector<Block> Blocks;
  std::unordered_map<std::uint64_t, int> Known;
};
}

#endif

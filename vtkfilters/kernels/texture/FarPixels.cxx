// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/FarPixels.h"

#include "core/DisjointSets.h"

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace novelview
{
namespace
{
constexpr double JumpPx = 3;        ///< a step in depth above this is another surface, pixels
constexpr double SeamWeight = 0.2;  ///< w: the seam's own noise must not become streaks
constexpr double Levels = 12;       ///< added to both sums of a ratio, grey levels
constexpr double MaxLogRatio = 1;   ///< of a correction
constexpr double KeepWeight = 5e-5; ///< of d = 0: what a seam says fades over some 140 pixels
constexpr double Tolerance = 1e-3;
constexpr int MaxIterations = 500;

/** Whether two pixels lie on the same surface. The same answer for q and p. */
bool OnSameSurface(const FarPixelInput& input, int px, int py, int qx, int qy)
{
  const auto [near, far] = std::minmax(input.Depth(px, py), input.Depth(qx, qy));
  return far - near < JumpPx * near / input.FocalLength;
}

/** The equations for the far pixels of a picture. */
class FarPixelSystem
{
public:
  explicit FarPixelSystem(const FarPixelInput& input)
    : Input(input)
    , Ids(input.Far.Width, input.Far.Height, 1, -1)
  {
    for (int y = 0; y < input.Far.Height; ++y)
    {
      for (int x = 0; x < input.Far.Width; ++x)
      {
        if (input.Far(x, y) || input.Seam(x, y))
        {
          this->Ids(x, y) = static_cast<int>(this->Pixels.size());
          this->Pixels.emplace_back(x, y);
        }
      }
    }
  }

  bool Empty() const { return this->Pixels.empty(); }

  void Level(Image<float>& color)
  {
    const auto count = static_cast<Eigen::Index>(this->Pixels.size());
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    this->Assemble(color, right);
    Eigen::SparseMatrix<double> matrix(count, count);
    matrix.setFromTriplets(this->Entries.begin(), this->Entries.end());
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> solver;
    solver.setTolerance(Tolerance);
    solver.setMaxIterations(MaxIterations);
    solver.compute(matrix);
    const Eigen::VectorXd d = solver.solve(right);
    for (std::size_t i = 0; i < this->Pixels.size(); ++i)
    {
      const auto [x, y] = this->Pixels[i];
      const auto factor = static_cast<float>(std::exp(std::clamp(d[i], -MaxLogRatio, MaxLogRatio)));
      for (int channel = 0; channel < 3 && this->Input.Far(x, y); ++channel)
      {
        color(x, y, channel) *= factor;
      }
    }
  }

private:
  void Assemble(const Image<float>& color, Eigen::VectorXd& right)
  {
    for (std::size_t i = 0; i < this->Pixels.size(); ++i)
    {
      const auto [x, y] = this->Pixels[i];
      const int id = static_cast<int>(i);
      double diagonal = KeepWeight;
      for (const auto& [dx, dy] : { std::pair(-1, 0), { 1, 0 }, { 0, -1 }, { 0, 1 } })
      {
        if (this->IsNeighbour(x, y, x + dx, y + dy))
        {
          diagonal += 1;
          this->Entries.emplace_back(id, this->Ids(x + dx, y + dy), -1);
        }
      }
      if (this->Input.Seam(x, y))
      {
        diagonal += SeamWeight;
        right(id) = SeamWeight *
          std::log(
            (Sum(&color(x, y)) + Levels) / (Sum(this->Input.SeamColor.Pixel(x, y)) + Levels));
      }
      this->Entries.emplace_back(id, id, diagonal);
    }
  }

  static double Sum(const float* rgb) { return rgb[0] + rgb[1] + rgb[2]; }

  /** Whether q has an unknown and lies on the same surface as p. */
  bool IsNeighbour(int px, int py, int qx, int qy) const
  {
    // The same answer for q and p: the matrix must be symmetric.
    return this->Ids.Ref().Contains(qx, qy) && this->Ids(qx, qy) >= 0 &&
      OnSameSurface(this->Input, px, py, qx, qy);
  }

  const FarPixelInput& Input;
  Image<int> Ids; ///< of the unknown of each pixel; -1 = none
  std::vector<std::pair<int, int>> Pixels;
  std::vector<Eigen::Triplet<double>> Entries;
};
}

void LevelFarPixels(const FarPixelInput& input, Image<float>& color)
{
  FarPixelSystem system(input);
  if (!system.Empty())
  {
    system.Level(color);
  }
}

std::vector<PixelList> FindFarIslands(
  const FarPixelInput& input, const ImageRef<const std::uint8_t>& unseen)
{
  const int width = input.Far.Width;
  // Regions of far and seam pixels, and regions of unseen ones.
  const auto kindOf = [&](int x, int y)
  { return unseen(x, y) ? 2 : (input.Far(x, y) || input.Seam(x, y) ? 1 : 0); };
  DisjointSets regions(width * input.Far.Height);
  std::vector<std::pair<int, int>> borders; // of a far and an unseen pixel
  for (int y = 0; y < input.Far.Height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (const auto& [qx, qy] : { std::pair(x + 1, y), { x, y + 1 } })
      {
        if (!input.Far.Contains(qx, qy))
        {
          continue;
        }
        const int kind = kindOf(x, y);
        const int other = kindOf(qx, qy);
        const int p = y * width + x;
        const int q = qy * width + qx;
        // Unseen pixels are filled from all around, whatever surface they lie on.
        if (kind > 0 && kind == other && (kind == 2 || OnSameSurface(input, x, y, qx, qy)))
        {
          regions.Unite(p, q);
        }
        else if (kind + other == 3)
        {
          kind == 1 ? borders.emplace_back(p, q) : borders.emplace_back(q, p);
        }
      }
    }
  }
  std::map<int, PixelList> members; // of each region, by its representative
  std::set<int> levelled;
  for (int y = 0; y < input.Far.Height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      if (kindOf(x, y) > 0)
      {
        const int region = regions.Find(y * width + x);
        members[region].emplace_back(x, y);
        if (input.Seam(x, y))
        {
          levelled.insert(region);
        }
      }
    }
  }
  std::set<int> islands;
  for (const auto& [farPixel, unseenPixel] : borders)
  {
    const int region = regions.Find(farPixel);
    if (!levelled.contains(region) &&
      members[region].size() < members[regions.Find(unseenPixel)].size())
    {
      islands.insert(region);
    }
  }
  std::vector<PixelList> result;
  for (const int island : islands)
  {
    result.push_back(members[island]);
  }
  return result;
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MeshNeighbours_h
#define novelview_MeshNeighbours_h

#include "geometry/TriangleMesh.h"

#include <span>
#include <vector>

namespace novelview
{
/** For every vertex the triangles it belongs to. */
class TrianglesOfPoints
{
public:
  explicit TrianglesOfPoints(const TriangleMesh& mesh);

  /** Ids of the triangles around a vertex, ascending. */
  std::span<const int> Triangles(int pointId) const
  {
    const std::size_t begin = this->Begin[pointId];
    return { this->Ids.data() + begin, this->Begin[pointId + 1] - begin };
  }

private:
  std::vector<std::size_t> Begin;
  std::vector<int> Ids;
};

/** And also the vertices it shares an edge with, which takes twice as long. */
class MeshNeighbours : public TrianglesOfPoints
{
public:
  explicit MeshNeighbours(const TriangleMesh& mesh);

  /** Ids of the adjacent vertices, ascending, each once. */
  std::span<const int> Points(int pointId) const
  {
    const std::size_t begin = this->PointBegin[pointId];
    return { this->PointIds.data() + begin, this->PointBegin[pointId + 1] - begin };
  }

private:
  std::vector<std::size_t> PointBegin;
  std::vector<int> PointIds;
};

/** Area-weighted unit normals, outward for counter-clockwise faces; zero where undefined. */
std::vector<Eigen::Vector3d> VertexNormals(const TriangleMesh& mesh);
}

#endif

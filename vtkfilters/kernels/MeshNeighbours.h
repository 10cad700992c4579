// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MeshNeighbours_h
#define novelview_MeshNeighbours_h

#include "TriangleMesh.h"

#include <span>
#include <vector>

namespace novelview
{
/** For every vertex the triangles it belongs to and the vertices it shares an edge with. */
class MeshNeighbours
{
public:
  explicit MeshNeighbours(const TriangleMesh& mesh);

  /** Ids of the triangles around a vertex, ascending. */
  std::span<const int> Triangles(int pointId) const
  {
    return Part(this->TriangleIds, this->TriangleBegin, pointId);
  }
  /** Ids of the adjacent vertices, ascending, each once. */
  std::span<const int> Points(int pointId) const
  {
    return Part(this->PointIds, this->PointBegin, pointId);
  }

private:
  static std::span<const int> Part(
    const std::vector<int>& ids, const std::vector<std::size_t>& begin, int i)
  {
    return { ids.data() + begin[i], begin[i + 1] - begin[i] };
  }
  std::vector<std::size_t> TriangleBegin, PointBegin;
  std::vector<int> TriangleIds, PointIds;
};

/** Area-weighted unit normals, outward for counter-clockwise faces; zero where undefined. */
std::vector<Eigen::Vector3d> VertexNormals(const TriangleMesh& mesh);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/MeshTopology.h"

#include "core/DisjointSets.h"
#include "core/Error.h"

#include <Eigen/Dense>

#include <algorithm>
#include <string>

namespace novelview
{
namespace
{
/** A triangle's edge from its corner `Corner` to the next one. */
struct HalfEdge
{
  int Low;
  int High;
  int Corner; ///< 3 * triangle + corner
  bool Up;    ///< runs from Low to High
};

int NextCorner(int corner)
{
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

bool IsDegenerate(const Eigen::Vector3i& t)
{
  return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

std::vector<HalfEdge> SortedHalfEdges(const TriangleMesh& mesh)
{
  std::vector<HalfEdge> edges;
  edges.reserve(mesh.Triangles.size() * 3);
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const Eigen::Vector3i& t = mesh.Triangles[i];
    for (int k = 0; !IsDegenerate(t) && k < 3; ++k)
    {
      const int a = t[k];
      const int b = t[(k + 1) % 3];
      edges.push_back({ std::min(a, b), std::max(a, b), static_cast<int>(3 * i) + k, a < b });
    }
  }
  std::sort(edges.begin(), edges.end(),
    [](const HalfEdge& a, const HalfEdge& b)
    {
      return a.Low != b.Low ? a.Low < b.Low
                            : (a.High != b.High ? a.High < b.High : a.Corner < b.Corner);
    });
  return edges;
}

void CheckIds(const TriangleMesh& mesh)
{
  const int count = static_cast<int>(mesh.Points.size());
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const Eigen::Vector3i& t = mesh.Triangles[i];
    if (t.minCoeff() < 0 || t.maxCoeff() >= count)
    {
      throw Error("mesh", "triangle " + std::to_string(i) + " names a point that does not exist",
        std::to_string(t.minCoeff() < 0 ? t.minCoeff() : t.maxCoeff()),
        "0 to " + std::to_string(count - 1));
    }
  }
}

/** Joins the corners that meet across an edge, so that each set left is one fan of a point. */
void CountEdges(const std::vector<HalfEdge>& edges, MeshTopology& topology, DisjointSets& fans)
{
  for (std::size_t begin = 0; begin < edges.size();)
  {
    std::size_t end = begin + 1;
    while (end < edges.size() && edges[end].Low == edges[begin].Low &&
      edges[end].High == edges[begin].High)
    {
      ++end;
    }
    ++topology.Edges;
    topology.BorderEdges += end - begin == 1;
    topology.NonManifoldEdges += end - begin > 2;
    topology.MisorientedEdges += end - begin == 2 && edges[begin].Up == edges[begin + 1].Up;
    for (std::size_t i = begin + 1; i < end; ++i)
    {
      const int a = edges[begin].Corner;
      const int b = edges[i].Corner;
      const bool same = edges[begin].Up == edges[i].Up;
      fans.Unite(a, same ? b : NextCorner(b));
      fans.Unite(NextCorner(a), same ? NextCorner(b) : b);
    }
    begin = end;
  }
}

/** Counts points, fans and components, once the corners are joined. */
void CountPoints(const TriangleMesh& mesh, MeshTopology& topology, DisjointSets& fans)
{
  const int count = static_cast<int>(mesh.Points.size());
  std::vector<int> fansOf(mesh.Points.size(), 0);
  DisjointSets pieces(count);
  for (std::size_t i = 0; i < mesh.Triangles.size(); ++i)
  {
    const Eigen::Vector3i& t = mesh.Triangles[i];
    if (IsDegenerate(t))
    {
      ++topology.DegenerateTriangles;
      continue;
    }
    ++topology.Triangles;
    for (int k = 0; k < 3; ++k)
    {
      const int corner = static_cast<int>(3 * i) + k;
      fansOf[t[k]] += fans.Find(corner) == corner;
      pieces.Unite(t[0], t[k]);
    }
  }
  for (int p = 0; p < count; ++p)
  {
    topology.UnusedPoints += fansOf[p] == 0;
    topology.NonManifoldPoints += fansOf[p] > 1;
    topology.Components += fansOf[p] > 0 && pieces.Find(p) == p;
  }
  topology.Points = count - topology.UnusedPoints;
}
}

MeshTopology ExamineTopology(const TriangleMesh& mesh)
{
  CheckIds(mesh);
  MeshTopology topology;
  DisjointSets fans(static_cast<int>(mesh.Triangles.size() * 3));
  CountEdges(SortedHalfEdges(mesh), topology, fans);
  CountPoints(mesh, topology, fans);
  return topology;
}

DroppedComponents KeepLargestComponent(TriangleMesh& mesh)
{
  DisjointSets sets(static_cast<int>(mesh.Points.size()));
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    sets.Unite(t[0], t[1]);
    sets.Unite(t[0], t[2]);
  }
  std::vector<std::size_t> sizes(mesh.Points.size());
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    ++sizes[sets.Find(t[0])];
  }
  const auto components =
    std::count_if(sizes.begin(), sizes.end(), [](std::size_t size) { return size > 0; });
  if (components == 0)
  {
    return {};
  }
  const auto largest =
    static_cast<int>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
  const DroppedComponents dropped{ static_cast<int>(components) - 1,
    mesh.Triangles.size() - sizes[largest] };
  std::erase_if(
    mesh.Triangles, [&](const Eigen::Vector3i& t) { return sets.Find(t[0]) != largest; });
  std::vector<int> places(mesh.Points.size(), -1);
  int kept = 0;
  for (int ptId = 0; ptId < static_cast<int>(places.size()); ++ptId)
  {
    if (sets.Find(ptId) == largest)
    {
      places[ptId] = kept;
      mesh.Points[kept++] = mesh.Points[ptId];
    }
  }
  mesh.Points.resize(kept);
  for (Eigen::Vector3i& t : mesh.Triangles)
  {
    t = { places[t[0]], places[t[1]], places[t[2]] };
  }
  return dropped;
}

double SignedVolume(const TriangleMesh& mesh)
{
  if (mesh.Points.empty())
  {
    return 0;
  }
  // Measured from a point of the mesh, so that an object far from the origin loses no digits.
  const Eigen::Vector3d& base = mesh.Points.front();
  double sixfold = 0;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const Eigen::Vector3d a = mesh.Points[t[0]] - base;
    const Eigen::Vector3d b = mesh.Points[t[1]] - base;
    const Eigen::Vector3d c = mesh.Points[t[2]] - base;
    sixfold += a.dot(b.cross(c));
  }
  return sixfold / 6;
}
}

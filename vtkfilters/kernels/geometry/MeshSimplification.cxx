// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/MeshSimplification.h"

#include "core/Error.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace novelview
{
namespace
{
namespace simplification = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

Point ToPoint(const Eigen::Vector3d& point)
{
  return { point.x(), point.y(), point.z() };
}

Surface ToSurface(const TriangleMesh& mesh)
{
  Surface surface;
  std::vector<Surface::Vertex_index> vertices;
  for (const Eigen::Vector3d& point : mesh.Points)
  {
    vertices.push_back(surface.add_vertex(ToPoint(point)));
  }
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    if (surface.add_face(vertices[t[0]], vertices[t[1]], vertices[t[2]]) == Surface::null_face())
    {
      throw Error("mesh", "it is not a manifold whose triangles are oriented alike");
    }
  }
  return surface;
}

TriangleMesh ToMesh(const Surface& surface)
{
  TriangleMesh mesh;
  std::vector<int> places(surface.number_of_vertices() + surface.number_of_removed_vertices(), -1);
  for (const Surface::Vertex_index vertex : surface.vertices())
  {
    if (!surface.is_isolated(vertex))
    {
      const Point& point = surface.point(vertex);
      places[vertex] = static_cast<int>(mesh.Points.size());
      mesh.Points.emplace_back(point.x(), point.y(), point.z());
    }
  }
  for (const Surface::Face_index face : surface.faces())
  {
    Eigen::Vector3i t;
    int corner = 0;
    for (const Surface::Vertex_index vertex : surface.vertices_around_face(surface.halfedge(face)))
    {
      t[corner++] = places[vertex];
    }
    mesh.Triangles.push_back(t);
  }
  return mesh;
}

/** Stops at a number of triangles, and when a stop is requested. */
class TrianglesLeft
{
public:
  TrianglesLeft(std::size_t triangles, const Execution& execution)
    : Triangles(triangles)
    , Run(execution)
  {
  }
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const
  {
    this->Run.CheckCancelled();
    return profile.surface_mesh().number_of_faces() <= this->Triangles;
  }

private:
  std::size_t Triangles;
  const Execution& Run;
};

double LargestDistance(const TriangleMesh& from, const Surface& to, const Execution& execution)
{
  using Primitive = CGAL::AABB_face_graph_triangle_primitive<Surface>;
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces(to).first, faces(to).second, to);
  tree.accelerate_distance_queries();
  std::vector<double> distances(from.Points.size());
  execution.ForEach(static_cast<std::int64_t>(distances.size()),
    [&](std::int64_t ptId)
    { distances[ptId] = std::sqrt(tree.squared_distance(ToPoint(from.Points[ptId]))); });
  return distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
}
}

//------------------------------------------------------------------------------
SimplifiedMesh SimplifyMesh(
  const TriangleMesh& mesh, std::size_t triangles, const Execution& execution)
{
  Surface surface = ToSurface(mesh);
  using Policies = simplification::GarlandHeckbert_plane_policies<Surface, Kernel>;
  Policies policies(surface);
  const auto placement = simplification::Bounded_normal_change_placement<Policies::Get_placement>(
    policies.get_placement());
  simplification::edge_collapse(surface, TrianglesLeft(triangles, execution),
    CGAL::parameters::get_cost(policies.get_cost()).get_placement(placement));
  surface.collect_garbage();
  return { ToMesh(surface), LargestDistance(mesh, surface, execution) };
}

//------------------------------------------------------------------------------
std::size_t CountSelfIntersections(const TriangleMesh& mesh)
{
  const Surface surface = ToSurface(mesh);
  std::vector<std::pair<Surface::Face_index, Surface::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(surface, std::back_inserter(pairs));
  return pairs.size();
}
}

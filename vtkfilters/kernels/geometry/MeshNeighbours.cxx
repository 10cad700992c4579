// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/MeshNeighbours.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace novelview
{
TrianglesOfPoints::TrianglesOfPoints(const TriangleMesh& mesh)
  : Begin(mesh.Points.size() + 1, 0)
{
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      ++this->Begin[t[corner] + 1];
    }
  }
  for (std::size_t i = 1; i < this->Begin.size(); ++i)
  {
    this->Begin[i] += this->Begin[i - 1];
  }
  this->Ids.resize(this->Begin.back());
  std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
  for (std::size_t cellId = 0; cellId < mesh.Triangles.size(); ++cellId)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      this->Ids[next[mesh.Triangles[cellId][corner]]++] = static_cast<int>(cellId);
    }
  }
}

MeshNeighbours::MeshNeighbours(const TriangleMesh& mesh)
  : TrianglesOfPoints(mesh)
  , PointBegin(mesh.Points.size() + 1, 0)
{
  this->PointIds.reserve(
    mesh.Points.size() + 3 * mesh.Triangles.size()); // enough for closed meshes
  std::vector<int> lastAt(mesh.Points.size(), -1);   // the point that a point was last found around
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    const int self = static_cast<int>(ptId);
    lastAt[ptId] = self;
    for (const int cellId : this->Triangles(self))
    {
      for (const int other : mesh.Triangles[cellId])
      {
        if (lastAt[other] != self)
        {
          lastAt[other] = self;
          this->PointIds.push_back(other);
        }
      }
    }
    std::sort(this->PointIds.begin() + static_cast<std::ptrdiff_t>(this->PointBegin[ptId]),
      this->PointIds.end());
    this->PointBegin[ptId + 1] = this->PointIds.size();
  }
}

std::vector<Eigen::Vector3d> VertexNormals(const TriangleMesh& mesh)
{
  std::vector<Eigen::Vector3d> normals(mesh.Points.size(), Eigen::Vector3d::Zero());
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const Eigen::Vector3d& a = mesh.Points[t[0]];
    const Eigen::Vector3d areaNormal = (mesh.Points[t[1]] - a).cross(mesh.Points[t[2]] - a);
    for (int corner = 0; corner < 3; ++corner)
    {
      normals[t[corner]] += areaNormal;
    }
  }
  for (Eigen::Vector3d& normal : normals)
  {
    const double length = normal.norm();
    normal = length > 0 ? Eigen::Vector3d(normal / length) : Eigen::Vector3d::Zero();
  }
  return normals;
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "MeshNeighbours.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace novelview
{
MeshNeighbours::MeshNeighbours(const TriangleMesh& mesh)
  : TriangleBegin(mesh.Points.size() + 1, 0)
  , PointBegin(mesh.Points.size() + 1, 0)
{
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      ++this->TriangleBegin[t[corner] + 1];
    }
  }
  for (std::size_t i = 1; i < this->TriangleBegin.size(); ++i)
  {
    this->TriangleBegin[i] += this->TriangleBegin[i - 1];
  }
  this->TriangleIds.resize(this->TriangleBegin.back());
  std::vector<std::size_t> next(this->TriangleBegin.begin(), this->TriangleBegin.end() - 1);
  for (std::size_t cellId = 0; cellId < mesh.Triangles.size(); ++cellId)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      this->TriangleIds[next[mesh.Triangles[cellId][corner]]++] = static_cast<int>(cellId);
    }
  }
  std::vector<int> around;
  for (std::size_t ptId = 0; ptId < mesh.Points.size(); ++ptId)
  {
    around.clear();
    for (const int cellId : this->Triangles(static_cast<int>(ptId)))
    {
      for (int corner = 0; corner < 3; ++corner)
      {
        const int other = mesh.Triangles[cellId][corner];
        if (other != static_cast<int>(ptId))
        {
          around.push_back(other);
        }
      }
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    this->PointIds.insert(this->PointIds.end(), around.begin(), around.end());
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

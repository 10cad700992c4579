// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/NovelProjection.h"

namespace novelview
{
NovelProjection::NovelProjection(const TriangleMesh& mesh, const Camera& camera)
  : Pixels(mesh.Points.size(), Eigen::Vector2d::Zero())
  , InFront(mesh.Points.size(), 0)
{
  for (std::size_t i = 0; i < mesh.Points.size(); ++i)
  {
    if (camera.Depth(mesh.Points[i]) > 0)
    {
      this->InFront[i] = 1;
      this->Pixels[i] = camera.Project(mesh.Points[i]);
    }
  }
}

TriangleMesh NovelProjection::FacingPart(const TriangleMesh& mesh, const Camera& camera)
{
  const NovelProjection projection(mesh, camera);
  TriangleMesh part;
  part.Points = mesh.Points;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    if (projection.Faces(t))
    {
      part.Triangles.push_back(t);
    }
  }
  return part;
}

bool NovelProjection::Faces(const Eigen::Vector3i& t) const
{
  return this->InFront[t[0]] && this->InFront[t[1]] && this->InFront[t[2]] &&
    ProjectedArea(this->Pixels[t[0]], this->Pixels[t[1]], this->Pixels[t[2]]) < 0;
}

bool NovelProjection::KeepsOrientation(const TriangleMesh& mesh, const TrianglesOfPoints& around,
  int pointId, const Eigen::Vector2d& moved) const
{
  for (const int cellId : around.Triangles(pointId))
  {
    const Eigen::Vector3i& t = mesh.Triangles[cellId];
    Eigen::Vector2d p[3];
    for (int corner = 0; corner < 3; ++corner)
    {
      p[corner] = t[corner] == pointId ? moved : this->Pixels[t[corner]];
    }
    if (ProjectedArea(p[0], p[1], p[2]) >= 0)
    {
      return false;
    }
  }
  return true;
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/ShadedMesh.h"

#include "geometry/MeshNeighbours.h"
#include "geometry/Rasteriser.h"

#include <array>
#include <cmath>

namespace novelview
{
using Eigen::Vector3d;

Camera TurnedCamera(const Camera& camera, const Vector3d& about, double angleDeg)
{
  // Down is positive in the camera's frame, so that it goes to the right for positive angles.
  const Vector3d down = camera.R.row(1).transpose();
  const Eigen::Matrix3d turn =
    Eigen::AngleAxisd(-angleDeg * EIGEN_PI / 180, down).toRotationMatrix();
  Camera turned = camera;
  turned.R = camera.R * turn.transpose();
  turned.T = -(turned.R * (about + turn * (camera.Centre() - about)));
  return turned;
}

Image<std::uint8_t> ShadedMesh(const TriangleMesh& mesh, const Camera& camera)
{
  constexpr std::array<double, 3> outside{ 214, 214, 208 };
  constexpr std::array<double, 3> inside{ 150, 84, 72 };
  constexpr double ambient = 0.2;
  Image<std::uint8_t> picture(camera.Width, camera.Height, 3);
  const ItemBuffer seen = Rasterise(mesh, camera);
  const std::vector<Vector3d> normals = VertexNormals(mesh);
  const Vector3d centre = camera.Centre();
  for (int y = 0; y < camera.Height; ++y)
  {
    for (int x = 0; x < camera.Width; ++x)
    {
      if (!seen.Hit(x, y))
      {
        continue;
      }
      const Eigen::Vector3i& t = mesh.Triangles[seen.CellId(x, y)];
      const Vector3d& corner = mesh.Points[t[0]];
      const Vector3d flat = (mesh.Points[t[1]] - corner).cross(mesh.Points[t[2]] - corner);
      const Vector3d towards = (centre - corner).normalized();
      const Vector3d normal = (normals[t[0]] + normals[t[1]] + normals[t[2]]).normalized();
      const double light = ambient + (1 - ambient) * std::abs(normal.dot(towards));
      const std::array<double, 3>& ink = flat.dot(towards) >= 0 ? outside : inside;
      for (int channel = 0; channel < 3; ++channel)
      {
        picture(x, y, channel) = static_cast<std::uint8_t>(std::lround(light * ink[channel]));
      }
    }
  }
  return picture;
}
}

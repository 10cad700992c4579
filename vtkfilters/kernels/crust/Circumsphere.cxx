// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/Circumsphere.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
/** Tetrahedra with six volumes below this part of their longest edge's cube are numerically flat. */
constexpr double FlatTetTolerance = 1e-11;

/** Circumcentre of the triangle a, b, c. */
Eigen::Vector3d CircumcentreOfTriangle(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  const Eigen::Vector3d u = b - a;
  const Eigen::Vector3d v = c - a;
  const Eigen::Vector3d n = u.cross(v);
  const double squared = n.squaredNorm();
  if (!(squared > 0))
  {
    return (a + b + c) / 3;
  }
  return a + (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2 * squared);
}

Eigen::Vector3d CircumcentreOfFlatTet(const DelaunayComplex& complex, int tet)
{
  double largest = -1;
  Eigen::Vector3d centre = complex.Points[complex.Tets[tet][0]];
  for (int i = 0; i < 4; ++i)
  {
    const std::array<int, 3> f = complex.Facet(tet, i);
    const Eigen::Vector3d& a = complex.Points[f[0]];
    const Eigen::Vector3d& b = complex.Points[f[1]];
    const Eigen::Vector3d& c = complex.Points[f[2]];
    const double area = (b - a).cross(c - a).squaredNorm();
    if (area > largest)
    {
      largest = area;
      centre = CircumcentreOfTriangle(a, b, c);
    }
  }
  return centre;
}
}

void ComputeCircumsphere(DelaunayComplex& complex, int tet)
{
  const std::array<int, 4>& t = complex.Tets[tet];
  const Eigen::Vector3d& base = complex.Points[t[0]];
  const Eigen::Vector3d u = complex.Points[t[1]] - base;
  const Eigen::Vector3d v = complex.Points[t[2]] - base;
  const Eigen::Vector3d w = complex.Points[t[3]] - base;
  const double det = u.dot(v.cross(w));
  const double longest = std::max({ u.squaredNorm(), v.squaredNorm(), w.squaredNorm() });
  if (det > FlatTetTolerance * longest * std::sqrt(longest))
  {
    const Eigen::Vector3d offset =
      (u.squaredNorm() * v.cross(w) + v.squaredNorm() * w.cross(u) + w.squaredNorm() * u.cross(v)) /
      (2 * det);
    complex.Centres[tet] = base + offset;
    complex.Radii[tet] = offset.norm();
    return;
  }
  complex.Centres[tet] = CircumcentreOfFlatTet(complex, tet);
  complex.Radii[tet] = (complex.Centres[tet] - base).norm();
}
}

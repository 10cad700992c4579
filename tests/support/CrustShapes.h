// SPDX-License-Identifier: GPL-3.0-or-later
// Sampled shapes with known surfaces, for the tests of the crust.
#ifndef novelview_tests_CrustShapes_h
#define novelview_tests_CrustShapes_h

#include <Eigen/Dense>

#include <cmath>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace novelview::shapes
{
using Points = std::vector<Eigen::Vector3d>;

/** A Fibonacci lattice turned by random noise: even, but in no special position. */
inline Points Sphere(
  int count, const Eigen::Vector3d& centre, double radius, double noise, unsigned int seed = 1)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  Points points;
  for (int i = 0; i < count; ++i)
  {
    const double z = 1 - (2 * i + 1.0) / count;
    const double ring = std::sqrt(1 - z * z);
    const double angle = i * 2.399963229728653; // the golden angle
    const Eigen::Vector3d direction(ring * std::cos(angle), ring * std::sin(angle), z);
    points.push_back(centre + direction * (radius + noise * normal(random)));
  }
  return points;
}

/** Distance between neighbours on such a sphere. */
inline double SphereSpacing(int count, double radius)
{
  return radius * std::sqrt(4 * EIGEN_PI / count);
}

/** Torus about z; even per area, by rejection. */
inline Points Torus(int count, double major, double minor, unsigned int seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  Points points;
  while (static_cast<int>(points.size()) < count)
  {
    const double a = 2 * EIGEN_PI * uniform(random);
    const double b = 2 * EIGEN_PI * uniform(random);
    const double r = major + minor * std::cos(b);
    if (uniform(random) * (major + minor) < r)
    {
      points.emplace_back(r * std::cos(a), r * std::sin(a), minor * std::sin(b));
    }
  }
  return points;
}

/** Surface points of a cube [0, 1]^3 on a regular grid of n steps per edge. */
inline Points CubeGrid(int n)
{
  Points points;
  for (int i = 0; i <= n; ++i)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int k = 0; k <= n; ++k)
      {
        if (i % n == 0 || j % n == 0 || k % n == 0)
        {
          points.push_back(Eigen::Vector3d(i, j, k) / n);
        }
      }
    }
  }
  return points;
}

/**
 * What a visual hull of three round silhouettes is: the intersection of three unit cylinders, with
 * sharp creases that no sample lies on exactly.
 */
inline Points ThreeCylinders(double spacing, unsigned int seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.15 * spacing, 0.15 * spacing);
  const int turns = static_cast<int>(2 * EIGEN_PI / spacing);
  Points points;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    for (int i = 0; i < turns; ++i)
    {
      for (double z = -1.1; z < 1.1; z += spacing)
      {
        const double angle = 2 * EIGEN_PI * i / turns + jitter(random);
        Eigen::Vector3d p;
        p[axis] = z + jitter(random);
        p[u] = std::cos(angle);
        p[v] = std::sin(angle);
        if (std::hypot(p[axis], p[u]) <= 1 && std::hypot(p[axis], p[v]) <= 1)
        {
          points.push_back(p);
        }
      }
    }
  }
  return points;
}

/** The Stanford bunny's vertices as glmark2-data installs them; empty when it is not there. */
inline Points Bunny()
{
  std::ifstream file("/usr/share/glmark2/models/bunny.obj");
  Points points;
  for (std::string line; std::getline(file, line);)
  {
    std::istringstream text(line);
    std::string key;
    Eigen::Vector3d p;
    if (text >> key && key == "v" && text >> p.x() >> p.y() >> p.z())
    {
      points.push_back(p);
    }
  }
  return points;
}
}

#endif

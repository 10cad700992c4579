// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/Poles.h"

#include "core/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
/** Circumspheres that differ by less than this part of their radius are one. */
constexpr double SameSphereTolerance = 1e-7;

bool AreCospherical(const DelaunayComplex& complex, int tetA, int tetB)
{
  const double tolerance = SameSphereTolerance * complex.Radii[tetA];
  return (complex.Centres[tetA] - complex.Centres[tetB]).squaredNorm() < tolerance * tolerance;
}

/** Per tetrahedron the lowest one with the same circumsphere that facets connect it to. */
std::vector<int> MergeCospherical(const DelaunayComplex& complex, const Execution& execution)
{
  std::vector<char> same(complex.Tets.size(), 0); // a bit per facet
  execution.ForEach(complex.NumberOfTets(),
    [&](std::int64_t tet)
    {
      for (int k = 0; k < 4; ++k)
      {
        const int other = complex.Neighbors[tet][k];
        same[tet] |= (other > tet && AreCospherical(complex, static_cast<int>(tet), other)) << k;
      }
    });
  DisjointSets sets(complex.NumberOfTets());
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    for (int k = 0; same[tet] >> k; ++k)
    {
      if (same[tet] >> k & 1)
      {
        sets.Unite(tet, complex.Neighbors[tet][k]);
      }
    }
  }
  std::vector<int> roots(complex.Tets.size());
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    roots[tet] = sets.Find(tet);
  }
  return roots;
}

/**
 * The direction the second pole must lie away from: that of the first pole; for a sample on the
 * convex hull the mean of those of all its spheres through far corners, which in the limit is the
 * mean normal of its hull facets (at a sharp corner a single one can lean far over).
 */
Eigen::Vector3d AwayDirection(const DelaunayComplex& complex, int sample, int firstPole)
{
  const Eigen::Vector3d& p = complex.Points[sample];
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = complex.IncidenceStart[sample]; i < complex.IncidenceStart[sample + 1]; ++i)
  {
    const int tet = complex.Incidence[i];
    if (complex.TouchesCorner(tet))
    {
      mean += (complex.Centres[tet] - p) / complex.Radii[tet];
    }
  }
  return complex.TouchesCorner(firstPole) ? mean : complex.Centres[firstPole] - p;
}

/** The tetrahedra whose circumcentres are the sample's poles; -1 where there is none. */
std::array<int, 2> PolesOfSample(const DelaunayComplex& complex, int sample)
{
  const int begin = complex.IncidenceStart[sample];
  const int end = complex.IncidenceStart[sample + 1];
  const Eigen::Vector3d& p = complex.Points[sample];
  std::array<int, 2> poles = { -1, -1 };
  double farthest = -1;
  for (int i = begin; i < end; ++i)
  {
    // All circumspheres of a sample pass through it: the radius is the distance.
    const int tet = complex.Incidence[i];
    if (complex.Radii[tet] > farthest)
    {
      farthest = complex.Radii[tet];
      poles[0] = tet;
    }
  }
  if (poles[0] < 0)
  {
    return poles;
  }
  const Eigen::Vector3d direction = AwayDirection(complex, sample, poles[0]);
  farthest = -1;
  for (int i = begin; i < end; ++i)
  {
    const int tet = complex.Incidence[i];
    if (complex.Radii[tet] > farthest && direction.dot(complex.Centres[tet] - p) < 0)
    {
      farthest = complex.Radii[tet];
      poles[1] = tet;
    }
  }
  return poles;
}
}

Poles FindPoles(const DelaunayComplex& complex, bool allCertain, const Execution& execution)
{
  const std::vector<int> roots = MergeCospherical(complex, execution);
  Poles poles;
  poles.OfSample.resize(static_cast<std::size_t>(complex.NumberOfSamples));
  execution.ForEach(complex.NumberOfSamples,
    [&](std::int64_t sample)
    { poles.OfSample[sample] = PolesOfSample(complex, static_cast<int>(sample)); });

  // A merged pole is certainly outside when any of its tetrahedra is.
  std::vector<char> certain(complex.Tets.size(), 0);
  std::vector<char> listed(complex.Tets.size(), 0);
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    certain[roots[tet]] |= complex.TouchesCorner(tet);
    listed[roots[tet]] = allCertain && certain[roots[tet]];
  }
  for (const std::array<int, 2>& pair : poles.OfSample)
  {
    for (int tet : pair)
    {
      if (tet >= 0)
      {
        listed[roots[tet]] = 1;
      }
    }
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    if (listed[tet])
    {
      poles.Tets.push_back(tet);
      poles.Balls.Centres.push_back(complex.Centres[tet]);
      poles.Balls.Radii.push_back(complex.Radii[tet]);
      poles.Certain.push_back(certain[tet]);
    }
  }
  return poles;
}
}

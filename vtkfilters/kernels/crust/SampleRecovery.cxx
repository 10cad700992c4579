// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/SampleRecovery.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <deque>

namespace novelview
{
namespace
{
/**
 * How flat the pyramid is that replaces facet `facet` of a tetrahedron by the three others: the
 * least cos of the angle between the normals of the new facets and of the old one.
 */
double PyramidFlatness(const DelaunayComplex& complex, int tet, int facet)
{
  auto normalOf = [&](int k) -> Eigen::Vector3d
  {
    const std::array<int, 3> f = complex.Facet(tet, k);
    const Eigen::Vector3d& a = complex.Points[f[0]];
    return (complex.Points[f[1]] - a).cross(complex.Points[f[2]] - a).stableNormalized();
  };
  const Eigen::Vector3d base = normalOf(facet);
  double least = 1;
  for (int k = 0; k < 4; ++k)
  {
    if (k != facet)
    {
      least = std::min(least, -base.dot(normalOf(k)));
    }
  }
  return least;
}

/** New facets may lean at most this far from the facet they replace: cos of 75 degrees. */
constexpr double ShallowCosine = 0.26;

/** The tetrahedron whose turning over brings a buried sample out best; -1 when none does. */
int BestPyramid(const DelaunayComplex& complex, const std::vector<Side>& labels, int sample)
{
  int best = -1;
  double flattest = ShallowCosine;
  for (int i = complex.IncidenceStart[sample]; i < complex.IncidenceStart[sample + 1]; ++i)
  {
    const int tet = complex.Incidence[i];
    const std::array<int, 4>& t = complex.Tets[tet];
    const int facet = static_cast<int>(std::find(t.begin(), t.end(), sample) - t.begin());
    const int other = complex.Neighbors[tet][facet];
    if (complex.TouchesCorner(tet) || other < 0 || labels[other] == labels[tet])
    {
      continue;
    }
    const double flatness = PyramidFlatness(complex, tet, facet);
    if (flatness > flattest)
    {
      flattest = flatness;
      best = tet;
    }
  }
  return best;
}
}

int RecoverSamples(const DelaunayComplex& complex, std::vector<Side>& labels)
{
  std::deque<int> queue;
  for (int s = 0; s < complex.NumberOfSamples; ++s)
  {
    if (IsInterior(complex, labels, s))
    {
      queue.push_back(s);
    }
  }
  // Samples under samples: once more around as long as that brings some out.
  int recovered = 0;
  for (bool progress = true; progress;)
  {
    progress = false;
    std::deque<int> left;
    for (int sample : queue)
    {
      const int tet = BestPyramid(complex, labels, sample);
      if (tet < 0)
      {
        left.push_back(sample);
        continue;
      }
      labels[tet] = Opposite(labels[tet]);
      ++recovered;
      progress = true;
    }
    queue.swap(left);
  }
  return recovered;
}
}

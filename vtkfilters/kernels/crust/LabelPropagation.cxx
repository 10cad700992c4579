// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/LabelPropagation.h"

#include "core/DisjointSets.h"
#include "crust/Poles.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace novelview
{
namespace
{
double Agreement(const DelaunayComplex& complex, int tetA, int tetB)
{
  return BallAgreement(
    complex.Centres[tetA], complex.Radii[tetA], complex.Centres[tetB], complex.Radii[tetB]);
}

/** A facet over which a label can spread. */
struct WeightedEdge
{
  double Agreement = -2; ///< below any
  int From = -1;         ///< the tetrahedron that may take the label; -1 = none
  int To = -1;

  /** A strict order of the facets, the same from both sides. */
  bool StrongerThan(const WeightedEdge& other) const
  {
    return this->Agreement != other.Agreement
      ? this->Agreement > other.Agreement
      : std::minmax(this->From, this->To) < std::minmax(other.From, other.To);
  }
};

/** The strongest facet by which a tetrahedron joins another region. */
WeightedEdge StrongestEdge(const DelaunayComplex& complex, const std::vector<int>& regions, int tet)
{
  WeightedEdge strongest;
  for (int other : complex.Neighbors[tet])
  {
    if (other >= 0 && regions[other] != regions[tet])
    {
      const WeightedEdge edge{ Agreement(complex, tet, other), tet, other };
      strongest = edge.StrongerThan(strongest) ? edge : strongest;
    }
  }
  return strongest;
}
}

void PropagateLabels(
  const DelaunayComplex& complex, std::vector<Side>& labels, const Execution& execution)
{
  DisjointSets sets(complex.NumberOfTets());
  std::vector<int> regions(labels.size());
  std::iota(regions.begin(), regions.end(), 0);
  std::vector<int> open; // tetrahedra without a label
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    if (labels[tet] == Side::Unknown)
    {
      open.push_back(tet);
    }
  }
  std::vector<WeightedEdge> edges;
  std::vector<WeightedEdge> edgeOfRegion(labels.size());
  while (!open.empty())
  {
    edges.resize(open.size());
    execution.ForEach(static_cast<std::int64_t>(open.size()),
      [&](std::int64_t i) { edges[i] = StrongestEdge(complex, regions, open[i]); });
    for (std::size_t i = 0; i < open.size(); ++i)
    {
      WeightedEdge& strongest = edgeOfRegion[regions[open[i]]];
      strongest = edges[i].StrongerThan(strongest) ? edges[i] : strongest;
    }
    for (int tet : open)
    {
      const WeightedEdge edge = std::exchange(edgeOfRegion[regions[tet]], WeightedEdge());
      if (edge.From >= 0)
      {
        const int from = sets.Find(edge.From);
        const int to = sets.Find(edge.To);
        const Side label = labels[from] != Side::Unknown ? labels[from] : labels[to];
        sets.Unite(from, to);
        labels[sets.Find(from)] = label;
      }
    }
    std::erase_if(open,
      [&](int tet)
      {
        regions[tet] = sets.Find(tet);
        return labels[regions[tet]] != Side::Unknown;
      });
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    labels[tet] = labels[sets.Find(tet)];
  }
}
}

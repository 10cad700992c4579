// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/SmallComponents.h"

#include "core/DisjointSets.h"

#include <algorithm>

namespace novelview
{
namespace
{
/** Pieces of equal label connected through facets: per tetrahedron the piece's lowest one. */
std::vector<int> FindComponents(const DelaunayComplex& complex, const std::vector<Side>& labels)
{
  DisjointSets sets(complex.NumberOfTets());
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    for (int other : complex.Neighbors[tet])
    {
      if (other > tet && labels[other] == labels[tet])
      {
        sets.Unite(tet, other);
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

/** Per piece root, how many different points its tetrahedra have. */
std::vector<int> CountPiecePoints(const DelaunayComplex& complex, const std::vector<int>& roots)
{
  std::vector<int> counts(complex.Tets.size(), 0);
  std::vector<int> seen;
  for (std::size_t p = 0; p < complex.Points.size(); ++p)
  {
    seen.clear();
    for (int i = complex.IncidenceStart[p]; i < complex.IncidenceStart[p + 1]; ++i)
    {
      const int root = roots[complex.Incidence[i]];
      if (std::find(seen.begin(), seen.end(), root) == seen.end())
      {
        seen.push_back(root);
        ++counts[root];
      }
    }
  }
  return counts;
}
}

int RemoveSmallComponents(
  const DelaunayComplex& complex, int minimumSamples, std::vector<Side>& labels)
{
  const std::vector<int> roots = FindComponents(complex, labels);
  const std::vector<int> counts = CountPiecePoints(complex, roots);
  int largest = -1; // of the inside; the outside's is the one with the far corners
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    const bool root = roots[tet] == tet && labels[tet] == Side::Inside;
    largest = root && (largest < 0 || counts[tet] > counts[largest]) ? tet : largest;
  }
  std::vector<char> small(complex.Tets.size(), 0);
  int removed = 0;
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    small[tet] = roots[tet] == tet && tet != largest && counts[tet] < minimumSamples;
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    if (complex.TouchesCorner(tet))
    {
      small[roots[tet]] = 0;
    }
  }
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    removed += small[tet];
    labels[tet] = small[roots[tet]] ? Opposite(labels[tet]) : labels[tet];
  }
  return removed;
}
}

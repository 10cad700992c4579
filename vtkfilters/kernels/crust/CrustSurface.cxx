// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/CrustSurface.h"

#include <Eigen/Dense>

#include <algorithm>
#include <numeric>
#include <utility>

namespace novelview
{
namespace
{
int NextCorner(int corner)
{
  return corner % 3 == 2 ? corner - 2 : corner + 1;
}

/**
 * Triangles over point ids with their neighbours: half-edge c runs from corner c to the next one
 * of its triangle, Twins[c] is the half-edge on the other side.
 */
struct HalfEdgeSoup
{
  std::vector<int> Corners; ///< point id, 3 per triangle
  std::vector<int> Twins;
};

/**
 * The boundary facet on the other side of the run of inside tetrahedra around the edge (u, v),
 * starting from facet `facet` of `tet`. Returns 4 * tetrahedron + facet.
 */
int TurnAroundEdge(
  const DelaunayComplex& complex, const std::vector<Side>& labels, int tet, int facet, int u, int v)
{
  int entered = complex.Tets[tet][facet]; // the vertex opposite the facet we come from
  while (true)
  {
    // Leave through the other facet with this edge: opposite the vertex that is none of the three.
    const std::array<int, 4>& t = complex.Tets[tet];
    int exit = 0;
    while (t[exit] == u || t[exit] == v || t[exit] == entered)
    {
      ++exit;
    }
    const int other = complex.Neighbors[tet][exit];
    if (other < 0 || labels[other] != Side::Inside)
    {
      return 4 * tet + exit;
    }
    // `entered` is on the shared facet; in the next one the vertex opposite it is the new one.
    const std::array<int, 4>& next = complex.Tets[other];
    int fresh = 0;
    while (next[fresh] == u || next[fresh] == v || next[fresh] == entered)
    {
      ++fresh;
    }
    entered = next[fresh];
    tet = other;
  }
}

HalfEdgeSoup CollectBoundary(
  const DelaunayComplex& complex, const std::vector<Side>& labels, const Execution& execution)
{
  HalfEdgeSoup soup;
  std::vector<int> facets;                                  // 4 * tetrahedron + facet
  std::vector<int> triangleOf(complex.Tets.size() * 4, -1); // the way back
  for (int tet = 0; tet < complex.NumberOfTets(); ++tet)
  {
    for (int k = 0; labels[tet] == Side::Inside && k < 4; ++k)
    {
      const int other = complex.Neighbors[tet][k];
      if (other < 0 || labels[other] != Side::Inside)
      {
        triangleOf[4 * tet + k] = static_cast<int>(facets.size());
        facets.push_back(4 * tet + k);
        const std::array<int, 3> f = complex.Facet(tet, k);
        soup.Corners.insert(soup.Corners.end(), f.begin(), f.end());
      }
    }
  }
  soup.Twins.resize(soup.Corners.size());
  execution.ForEach(static_cast<std::int64_t>(soup.Corners.size()),
    [&](std::int64_t corner)
    {
      const int facet = facets[corner / 3];
      const int u = soup.Corners[corner];
      const int v = soup.Corners[NextCorner(static_cast<int>(corner))];
      const int twin = 3 * triangleOf[TurnAroundEdge(complex, labels, facet / 4, facet % 4, u, v)];
      const int* ids = &soup.Corners[twin];
      soup.Twins[corner] = twin + (ids[0] == v ? 0 : (ids[1] == v ? 1 : 2));
    });
  return soup;
}

/** Numbers the points, one per fan of triangles, ordered by sample and then by first triangle. */
void NumberPoints(const DelaunayComplex& complex, HalfEdgeSoup& soup, CrustSurface& surface)
{
  std::vector<int> fanOf(soup.Corners.size(), -1); // of each corner
  std::vector<std::pair<int, int>> fans;           // sample, number in the order of first corners
  for (int first = 0; first < static_cast<int>(soup.Corners.size()); ++first)
  {
    if (fanOf[first] < 0)
    {
      const int fan = static_cast<int>(fans.size());
      fans.emplace_back(soup.Corners[first], fan);
      for (int corner = first; fanOf[corner] < 0; corner = NextCorner(soup.Twins[corner]))
      {
        fanOf[corner] = fan;
      }
    }
  }
  std::sort(fans.begin(), fans.end());
  std::vector<int> pointOf(fans.size()); // of each fan
  for (std::size_t i = 0; i < fans.size(); ++i)
  {
    pointOf[fans[i].second] = static_cast<int>(i);
    surface.Mesh.Points.push_back(complex.Points[fans[i].first]);
    surface.PointSources.push_back(fans[i].first);
    surface.SplitPoints += i > 0 && fans[i].first == fans[i - 1].first;
  }
  for (std::size_t corner = 0; corner < fanOf.size(); ++corner)
  {
    soup.Corners[corner] = pointOf[fanOf[corner]];
  }
}

/** Cuts the two triangles of half-edge `corner` at the middle of that edge. */
void CutEdge(HalfEdgeSoup& soup, int corner, int midPoint)
{
  // Triangle (u, v, a) becomes (u, m, a) and (m, v, a); its twin (v, u, b): (v, m, b), (m, u, b).
  const int sides[2] = { corner, soup.Twins[corner] };
  int fresh[2];
  for (int i = 0; i < 2; ++i)
  {
    const int edge = sides[i];
    const int toApex = NextCorner(edge);
    const int fromApex = NextCorner(toApex);
    const int first = static_cast<int>(soup.Corners.size());
    fresh[i] = first;
    soup.Corners.insert(
      soup.Corners.end(), { midPoint, soup.Corners[toApex], soup.Corners[fromApex] });
    soup.Twins.insert(soup.Twins.end(), { -1, soup.Twins[toApex], toApex });
    soup.Twins[soup.Twins[toApex]] = first + 1;
    soup.Corners[toApex] = midPoint;
    soup.Twins[toApex] = first + 2;
  }
  // (u, m) of the one side meets (m, u) of the other, and the same at v.
  soup.Twins[sides[0]] = fresh[1];
  soup.Twins[fresh[1]] = sides[0];
  soup.Twins[sides[1]] = fresh[0];
  soup.Twins[fresh[0]] = sides[1];
}

/** Low end, high end and half-edge from low to high of every edge, in ascending order. */
std::vector<std::array<int, 3>> SortedEdges(const HalfEdgeSoup& soup, std::size_t numberOfPoints)
{
  const int count = static_cast<int>(soup.Corners.size());
  auto isUp = [&](int corner) { return soup.Corners[corner] < soup.Corners[NextCorner(corner)]; };
  std::vector<int> start(numberOfPoints + 1, 0); // of the edges with this low end
  for (int corner = 0; corner < count; ++corner)
  {
    start[soup.Corners[corner] + 1] += isUp(corner);
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::array<int, 3>> edges(static_cast<std::size_t>(start.back()));
  std::vector<int> next(start.begin(), start.end() - 1);
  for (int corner = 0; corner < count; ++corner)
  {
    if (isUp(corner))
    {
      const int low = soup.Corners[corner];
      edges[next[low]++] = { low, soup.Corners[NextCorner(corner)], corner };
    }
  }
  for (std::size_t i = 0; i < numberOfPoints; ++i)
  {
    std::sort(edges.begin() + start[i], edges.begin() + start[i + 1]);
  }
  return edges;
}

/** Puts a midpoint on every edge but one of those with the same two ends. */
void CutMultipleEdges(HalfEdgeSoup& soup, CrustSurface& surface)
{
  const std::vector<std::array<int, 3>> edges = SortedEdges(soup, surface.Mesh.Points.size());
  for (std::size_t i = 1; i < edges.size(); ++i)
  {
    const int low = edges[i][0];
    const int high = edges[i][1];
    int corner = edges[i][2];
    if (low == edges[i - 1][0] && high == edges[i - 1][1])
    {
      // An earlier cut may have moved the half-edge after the one it cut: its old place now starts
      // at the midpoint, and the new triangle is across it.
      if (soup.Corners[corner] != low)
      {
        corner = NextCorner(NextCorner(soup.Twins[corner]));
      }
      CutEdge(soup, corner, static_cast<int>(surface.Mesh.Points.size()));
      surface.Mesh.Points.push_back(0.5 * (surface.Mesh.Points[low] + surface.Mesh.Points[high]));
      surface.PointSources.push_back(surface.PointSources[low]);
      ++surface.MidPoints;
    }
  }
}
}

CrustSurface ExtractDelaunayCrust(
  const DelaunayComplex& complex, const std::vector<Side>& labels, const Execution& execution)
{
  CrustSurface surface;
  HalfEdgeSoup soup = CollectBoundary(complex, labels, execution);
  NumberPoints(complex, soup, surface);
  CutMultipleEdges(soup, surface);
  surface.Mesh.Triangles.reserve(soup.Corners.size() / 3);
  for (std::size_t i = 0; i < soup.Corners.size(); i += 3)
  {
    surface.Mesh.Triangles.emplace_back(soup.Corners[i], soup.Corners[i + 1], soup.Corners[i + 2]);
  }
  return surface;
}
}

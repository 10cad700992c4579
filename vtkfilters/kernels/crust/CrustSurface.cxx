// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/CrustSurface.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
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

int IndexOf(const std::array<int, 4>& tet, int point)
{
  return static_cast<int>(std::find(tet.begin(), tet.end(), point) - tet.begin());
}

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

//------------------------------------------------------------------------------
/** Power-diagram planes closer to parallel than this (sine) do not fix a vertex between them. */
constexpr double ParallelTolerance = 1e-7;

/**
 * The point with the same power to the four balls of a regular tetrahedron. Where they leave a
 * direction open (degenerate input), the solution nearest to where an inside and an outside ball
 * meet.
 */
Eigen::Vector3d PowerVertex(
  const std::array<int, 4>& tet, const Balls& balls, const std::vector<Side>& labels)
{
  int in = tet[0];
  int out = tet[0];
  for (int ball : tet)
  {
    in = labels[ball] == Side::Inside ? ball : in;
    out = labels[ball] == Side::Inside ? out : ball;
  }
  const double sum = balls.Radii[in] + balls.Radii[out];
  const Eigen::Vector3d anchor = balls.Centres[in] +
    (balls.Centres[out] - balls.Centres[in]) * (sum > 0 ? balls.Radii[in] / sum : 0.5);
  auto powerAt = [&](int ball)
  { return (balls.Centres[ball] - anchor).squaredNorm() - balls.Radii[ball] * balls.Radii[ball]; };
  Eigen::Matrix3d planes;
  Eigen::Vector3d offsets;
  for (int i = 1; i < 4; ++i)
  {
    const Eigen::Vector3d normal = balls.Centres[tet[i]] - balls.Centres[tet[0]];
    const double length = normal.norm();
    planes.row(i - 1) = normal.transpose() / length;
    offsets[i - 1] = 0.5 * (powerAt(tet[i]) - powerAt(tet[0])) / length;
  }
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d> solver;
  solver.setThreshold(ParallelTolerance);
  solver.compute(planes);
  return anchor + solver.solve(offsets);
}

/** The regular tetrahedra around the edge (inside, outside), counter-clockwise from outside. */
void CollectRing(
  const PowerDiagram& diagram, int start, int inside, int outside, std::vector<int>& ring)
{
  ring.clear();
  const std::array<int, 4>& tet = diagram.Tets[start];
  const int a = IndexOf(tet, inside);
  const int b = IndexOf(tet, outside);
  int c = 0;
  while (c == a || c == b)
  {
    ++c;
  }
  int d = 6 - a - b - c;
  // (a, b, c, d) must be an even permutation: then c to d is the counter-clockwise way.
  const int order[4] = { a, b, c, d };
  int inversions = 0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = i + 1; j < 4; ++j)
    {
      inversions += order[i] > order[j];
    }
  }
  if (inversions % 2 == 1)
  {
    std::swap(c, d);
  }
  int kept = tet[d];
  int exit = c;
  int current = start;
  do
  {
    ring.push_back(current);
    current = diagram.Neighbors[current][exit];
    const std::array<int, 4>& t = diagram.Tets[current];
    exit = IndexOf(t, kept);
    kept = t[6 - IndexOf(t, inside) - IndexOf(t, outside) - exit];
  } while (current != start);
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

TriangleMesh ExtractPowerCrust(const PowerDiagram& diagram, const Balls& balls,
  const std::vector<Side>& labels, const Execution& execution)
{
  TriangleMesh mesh;
  std::vector<int> pointOfTet(diagram.Tets.size(), -1);
  std::vector<int> tetOfPoint;
  std::vector<int> doneFor(balls.Radii.size(), -1); // the inside ball whose face is in already
  std::vector<int> ring;
  auto pointOf = [&](int tet)
  {
    if (pointOfTet[tet] < 0)
    {
      pointOfTet[tet] = static_cast<int>(tetOfPoint.size());
      tetOfPoint.push_back(tet);
    }
    return pointOfTet[tet];
  };
  for (int inside = 0; inside < static_cast<int>(labels.size()); ++inside)
  {
    const int begin = diagram.IncidenceStart[inside];
    const int end = diagram.IncidenceStart[inside + 1];
    for (int i = begin; labels[inside] == Side::Inside && i < end; ++i)
    {
      for (int ball : diagram.Tets[diagram.Incidence[i]])
      {
        if (labels[ball] == Side::Inside || doneFor[ball] == inside)
        {
          continue;
        }
        doneFor[ball] = inside;
        CollectRing(diagram, diagram.Incidence[i], inside, ball, ring);
        for (std::size_t k = 2; k < ring.size(); ++k)
        {
          const int first = pointOf(ring[0]);
          const int second = pointOf(ring[k - 1]);
          mesh.Triangles.emplace_back(first, second, pointOf(ring[k]));
        }
      }
    }
  }
  mesh.Points.resize(tetOfPoint.size());
  execution.ForEach(static_cast<std::int64_t>(tetOfPoint.size()),
    [&](std::int64_t i)
    { mesh.Points[i] = PowerVertex(diagram.Tets[tetOfPoint[i]], balls, labels); });
  return mesh;
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/Visibility.h"

#include "core/ToInt.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
using Eigen::Vector3d;

/** A vertex in the camera: position in the plane z = 1, and depth. */
struct Seen
{
  double X, Y, Z;
  bool InFront() const { return this->Z > 0; }
};

Seen Look(const Camera& camera, const Vector3d& point)
{
  const Vector3d p = camera.ToCamera(point);
  return p.z() > 0 ? Seen{ p.x() / p.z(), p.y() / p.z(), p.z() } : Seen{ 0, 0, p.z() };
}

bool Hides(const Seen& a, const Seen& b, const Seen& c, const Seen& p, double tolerance)
{
  if (p.Z <= std::min({ a.Z, b.Z, c.Z }) + tolerance)
  {
    return false;
  }
  const double area = (b.X - a.X) * (c.Y - a.Y) - (c.X - a.X) * (b.Y - a.Y);
  if (area == 0)
  {
    return false;
  }
  const double wa = ((b.X - p.X) * (c.Y - p.Y) - (c.X - p.X) * (b.Y - p.Y)) / area;
  const double wb = ((c.X - p.X) * (a.Y - p.Y) - (a.X - p.X) * (c.Y - p.Y)) / area;
  const double wc = 1 - wa - wb;
  if (wa < 0 || wb < 0 || wc < 0)
  {
    return false;
  }
  const double depth = 1 / (wa / a.Z + wb / b.Z + wc / c.Z);
  return p.Z > depth + tolerance;
}

/** A uniform grid over the projected mesh; cells hold ids of triangles in compressed rows. */
class TriangleGrid
{
public:
  TriangleGrid(const std::vector<Seen>& seen, const std::vector<Eigen::Vector3i>& triangles)
  {
    bool any = false;
    for (const Seen& p : seen)
    {
      if (p.InFront())
      {
        this->MinX = any ? std::min(this->MinX, p.X) : p.X;
        this->MinY = any ? std::min(this->MinY, p.Y) : p.Y;
        this->MaxX = any ? std::max(this->MaxX, p.X) : p.X;
        this->MaxY = any ? std::max(this->MaxY, p.Y) : p.Y;
        any = true;
      }
    }
    // About one cell per two triangles: the front and the back of a surface share a cell.
    const double side = std::sqrt(0.5 * static_cast<double>(triangles.size()));
    this->Size = std::clamp(ToInt(side), 1, 4096);
    this->Fill(seen, triangles);
  }

  std::pair<const int*, const int*> TrianglesAt(const Seen& p) const
  {
    const std::size_t cell =
      static_cast<std::size_t>(this->Index(p.Y, this->MinY, this->MaxY)) * this->Size +
      this->Index(p.X, this->MinX, this->MaxX);
    return { this->Ids.data() + this->Begin[cell], this->Ids.data() + this->Begin[cell + 1] };
  }

private:
  int Index(double value, double low, double high) const
  {
    if (!(high > low))
    {
      return 0;
    }
    return std::clamp(ToInt((value - low) / (high - low) * this->Size), 0, this->Size - 1);
  }

  template <class Visit>
  void ForEachCell(
    const std::vector<Seen>& seen, const Eigen::Vector3i& t, const Visit& visit) const
  {
    const Seen& a = seen[t[0]];
    const Seen& b = seen[t[1]];
    const Seen& c = seen[t[2]];
    if (!a.InFront() || !b.InFront() || !c.InFront())
    {
      return;
    }
    const auto [lowX, highX] = std::minmax({ a.X, b.X, c.X });
    const auto [lowY, highY] = std::minmax({ a.Y, b.Y, c.Y });
    const int x1 = this->Index(highX, this->MinX, this->MaxX);
    const int y1 = this->Index(highY, this->MinY, this->MaxY);
    for (int y = this->Index(lowY, this->MinY, this->MaxY); y <= y1; ++y)
    {
      for (int x = this->Index(lowX, this->MinX, this->MaxX); x <= x1; ++x)
      {
        visit(static_cast<std::size_t>(y) * this->Size + x);
      }
    }
  }

  void Fill(const std::vector<Seen>& seen, const std::vector<Eigen::Vector3i>& triangles)
  {
    this->Begin.assign(static_cast<std::size_t>(this->Size) * this->Size + 1, 0);
    for (const Eigen::Vector3i& t : triangles)
    {
      this->ForEachCell(seen, t, [this](std::size_t cell) { ++this->Begin[cell + 1]; });
    }
    for (std::size_t cell = 1; cell < this->Begin.size(); ++cell)
    {
      this->Begin[cell] += this->Begin[cell - 1];
    }
    this->Ids.resize(this->Begin.back());
    std::vector<std::size_t> next(this->Begin.begin(), this->Begin.end() - 1);
    for (std::size_t cellId = 0; cellId < triangles.size(); ++cellId)
    {
      this->ForEachCell(seen, triangles[cellId],
        [&](std::size_t cell) { this->Ids[next[cell]++] = static_cast<int>(cellId); });
    }
  }

  double MinX = 0, MinY = 0, MaxX = 0, MaxY = 0;
  int Size = 1;
  std::vector<std::size_t> Begin;
  std::vector<int> Ids;
};
}

double BoundingDiagonal(const std::vector<Vector3d>& points)
{
  return points.empty() ? 0 : BoundingBox(points).diagonal().norm();
}

bool HidesVertex(
  const TriangleMesh& mesh, const Camera& camera, int cellId, int pointId, double absoluteTolerance)
{
  const Eigen::Vector3i& t = mesh.Triangles[cellId];
  const Seen a = Look(camera, mesh.Points[t[0]]);
  const Seen b = Look(camera, mesh.Points[t[1]]);
  const Seen c = Look(camera, mesh.Points[t[2]]);
  const Seen p = Look(camera, mesh.Points[pointId]);
  if ((t.array() == pointId).any() || !a.InFront() || !b.InFront() || !c.InFront())
  {
    return false;
  }
  return p.InFront() && Hides(a, b, c, p, absoluteTolerance);
}

std::vector<std::uint8_t> VisibleVertices(
  const TriangleMesh& mesh, const Camera& camera, double tolerance, const Execution& execution)
{
  std::vector<Seen> seen(mesh.Points.size());
  execution.ForEach(static_cast<std::int64_t>(seen.size()),
    [&](std::int64_t i) { seen[i] = Look(camera, mesh.Points[i]); });
  const TriangleGrid grid(seen, mesh.Triangles);
  const double absolute = tolerance * BoundingDiagonal(mesh.Points);

  std::vector<std::uint8_t> visible(mesh.Points.size(), 0);
  execution.ForEach(static_cast<std::int64_t>(seen.size()),
    [&](std::int64_t pointId)
    {
      const Seen& p = seen[pointId];
      if (!p.InFront())
      {
        return;
      }
      const auto [begin, end] = grid.TrianglesAt(p);
      visible[pointId] = std::none_of(begin, end,
        [&](int cellId)
        {
          const Eigen::Vector3i& t = mesh.Triangles[cellId];
          return !(t.array() == pointId).any() &&
            Hides(seen[t[0]], seen[t[1]], seen[t[2]], p, absolute);
        });
    });
  return visible;
}

bool IsInside(const TriangleMesh& mesh, const Vector3d& point)
{
  if (!BoundingBox(mesh.Points).contains(point))
  {
    return false;
  }
  // Solid angle of each triangle by Van Oosterom and Strackee (1983).
  double halfAngles = 0;
  for (const Eigen::Vector3i& t : mesh.Triangles)
  {
    const Vector3d a = mesh.Points[t[0]] - point;
    const Vector3d b = mesh.Points[t[1]] - point;
    const Vector3d c = mesh.Points[t[2]] - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    halfAngles +=
      std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return std::abs(halfAngles) > EIGEN_PI; // half of the full 2 pi
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "Rasteriser.h"

#include "CpuClones.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace novelview
{
namespace
{
constexpr int BandRows = 32;
constexpr float NoDepth = std::numeric_limits<float>::infinity();

struct ProjectedPoint
{
  double X, Y;
  double InverseDepth; ///< 0 = at or behind the camera's plane
};

/** The part [XBegin, XEnd) x [YBegin, YEnd) of a frame. */
struct PixelBox
{
  int XBegin, XEnd, YBegin, YEnd;
  bool Empty() const { return this->XBegin >= this->XEnd || this->YBegin >= this->YEnd; }
};

/** The first integer not below `value`, cut to [0, size]. */
int FirstPixel(double value, int size)
{
  const double cut = std::clamp(value, 0.0, static_cast<double>(size));
  const int whole = static_cast<int>(cut);
  return whole + (whole < cut ? 1 : 0);
}

/** The first integer above `value`, cut to [0, size]. */
int EndPixel(double value, int size)
{
  return value < 0 ? 0 : static_cast<int>(std::min(value + 1, static_cast<double>(size)));
}

/**
 * Twice the signed area of a point with an edge, A x + B y + C. With the edge's ends swapped it is
 * the same with the other sign, to the last bit: no point falls between two triangles that share it.
 */
struct EdgeFunction
{
  double A;
  double B;
  double C;

  EdgeFunction(const ProjectedPoint& from, const ProjectedPoint& to, double sign)
    : A(sign * (from.Y - to.Y))
    , B(sign * (to.X - from.X))
    , C(sign * (from.X * to.Y - to.X * from.Y))
  {
  }
  /** Its part that is the same for a whole row. */
  double Row(double y) const { return this->B * y + this->C; }
};

/** A triangle in the picture. */
struct ProjectedTriangle
{
  ProjectedPoint P[3];
  double Area; ///< twice the signed area

  explicit ProjectedTriangle(
    const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c)
    : P{ a, b, c }
    , Area((b.X - a.X) * (c.Y - a.Y) - (c.X - a.X) * (b.Y - a.Y))
  {
  }

  /** Whether it has an area, and all of it is in front of the camera. */
  bool Drawn() const
  {
    return this->P[0].InverseDepth > 0 && this->P[1].InverseDepth > 0 &&
      this->P[2].InverseDepth > 0 && this->Area != 0 && std::isfinite(this->Area);
  }

  /** The pixels whose centre is no further than `margin` outside its bounding box. */
  PixelBox Box(double margin, int width, int height) const
  {
    const auto [xMin, xMax] = std::minmax({ this->P[0].X, this->P[1].X, this->P[2].X });
    const auto [yMin, yMax] = std::minmax({ this->P[0].Y, this->P[1].Y, this->P[2].Y });
    return { FirstPixel(xMin - margin, width), EndPixel(xMax + margin, width),
      FirstPixel(yMin - margin, height), EndPixel(yMax + margin, height) };
  }
};

/** Depths over a triangle. */
class TriangleDepth
{
public:
  explicit TriangleDepth(const ProjectedTriangle& triangle)
    : TriangleDepth(triangle.P[0], triangle.P[1], triangle.P[2], triangle.Area > 0 ? 1 : -1)
  {
  }

  /** Calls take(x, depth) for the places x = first, first + 1 .. of a row that it covers. */
  template <class Take>
  void ForRow(double y, double first, int count, const Take& take) const
  {
    const double row0 = this->Edges[0].Row(y);
    const double row1 = this->Edges[1].Row(y);
    const double row2 = this->Edges[2].Row(y);
    for (int i = 0; i < count; ++i)
    {
      const double x = first + i;
      const double w0 = this->Edges[0].A * x + row0;
      const double w1 = this->Edges[1].A * x + row1;
      const double w2 = this->Edges[2].A * x + row2;
      if (w0 >= 0 && w1 >= 0 && w2 >= 0)
      {
        take(i,
          static_cast<float>((w0 + w1 + w2) /
            (w0 * this->InverseDepth[0] + w1 * this->InverseDepth[1] +
              w2 * this->InverseDepth[2])));
      }
    }
  }

  /**
   * Puts the depths of the pixels of a box into a picture of the nearest, and one of the farthest
   * unless that is null. Four pixels at once: up to three after the last one must be there.
   */
  [[gnu::always_inline]] inline void Draw(
    const PixelBox& box, int width, float* nearest, float* farthest) const
  {
    using Doubles [[gnu::vector_size(32)]] = double;
    using Floats [[gnu::vector_size(16)]] = float;
    using Ints [[gnu::vector_size(16)]] = std::int32_t;
    for (int y = box.YBegin; y < box.YEnd; ++y)
    {
      const double row0 = this->Edges[0].Row(y);
      const double row1 = this->Edges[1].Row(y);
      const double row2 = this->Edges[2].Row(y);
      for (int first = box.XBegin; first < box.XEnd; first += 4)
      {
        const Doubles x = static_cast<double>(first) + Doubles{ 0, 1, 2, 3 };
        const Doubles w0 = this->Edges[0].A * x + row0;
        const Doubles w1 = this->Edges[1].A * x + row1;
        const Doubles w2 = this->Edges[2].A * x + row2;
        const Floats depth = __builtin_convertvector((w0 + w1 + w2) /
            (w0 * this->InverseDepth[0] + w1 * this->InverseDepth[1] + w2 * this->InverseDepth[2]),
          Floats);
        const auto covered = __builtin_convertvector(
          (w0 >= 0) & (w1 >= 0) & (w2 >= 0) & (x < static_cast<double>(box.XEnd)), Ints);
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * width + first;
        Floats before;
        std::memcpy(&before, nearest + at, sizeof(before));
        Floats after = (covered & (depth < before)) ? depth : before;
        std::memcpy(nearest + at, &after, sizeof(after));
        if (farthest)
        {
          std::memcpy(&before, farthest + at, sizeof(before));
          after = (covered & (depth > before)) ? depth : before;
          std::memcpy(farthest + at, &after, sizeof(after));
        }
      }
    }
  }

private:
  TriangleDepth(
    const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c, double sign)
    : Edges{ { b, c, sign }, { c, a, sign }, { a, b, sign } }
    , InverseDepth{ a.InverseDepth, b.InverseDepth, c.InverseDepth }
  {
  }

  EdgeFunction Edges[3]; ///< opposite to each corner
  double InverseDepth[3];
};

std::vector<ProjectedPoint> ProjectPoints(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
{
  const Eigen::Matrix3d M = camera.K * camera.R;
  const Eigen::Vector3d t = camera.K * camera.T;
  std::vector<ProjectedPoint> points(mesh.Points.size());
  execution.ForEach(static_cast<std::int64_t>(mesh.Points.size()),
    [&](std::int64_t i)
    {
      const Eigen::Vector3d p = M * mesh.Points[i] + t;
      const double inverse = p.z() > 0 ? 1 / p.z() : 0;
      points[i] = { p.x() * inverse, p.y() * inverse, inverse };
    });
  return points;
}

/** The triangles of a mesh, projected and sorted into bands of rows that are drawn in parallel. */
class TriangleBands
{
public:
  /** @param margin as for ProjectedTriangle::Box. */
  TriangleBands(
    const TriangleMesh& mesh, const Camera& camera, double margin, const Execution& execution)
    : Mesh(mesh)
    , Run(execution)
    , Margin(margin)
    , Width(camera.Width)
    , Height(camera.Height)
    , Points(ProjectPoints(mesh, camera, execution))
  {
    execution.ForEach(Parts,
      [&](std::int64_t part)
      {
        std::vector<std::vector<int>>& cellsOfBand = this->CellsOfBand[part];
        cellsOfBand.resize(this->NumberOfBands());
        const std::size_t count = mesh.Triangles.size();
        for (std::size_t cellId = part * count / Parts; cellId < (part + 1) * count / Parts;
             ++cellId)
        {
          this->Sort(static_cast<int>(cellId), cellsOfBand);
        }
      });
  }

  /**
   * Calls draw(cellId, triangle, box) for every triangle and band, bands in parallel, the triangles
   * of a band in the order of their ids; box is the triangle's part of the band.
   */
  template <class Draw>
  void ForEach(const Draw& draw) const
  {
    this->Run.ForEach(this->NumberOfBands(),
      [&](std::int64_t band)
      {
        const int rowBegin = static_cast<int>(band) * BandRows;
        for (const std::vector<std::vector<int>>& cellsOfBand : this->CellsOfBand)
        {
          for (const int cellId : cellsOfBand[band])
          {
            const ProjectedTriangle triangle = this->Projected(cellId);
            PixelBox box = triangle.Box(this->Margin, this->Width, this->Height);
            box.YBegin = std::max(box.YBegin, rowBegin);
            box.YEnd = std::min(box.YEnd, rowBegin + BandRows);
            draw(cellId, triangle, box);
          }
        }
      });
  }

private:
  /** The triangles are sorted in so many parts in parallel; each keeps the order of their ids. */
  static constexpr int Parts = 16;

  int NumberOfBands() const { return (this->Height + BandRows - 1) / BandRows; }

  void Sort(int cellId, std::vector<std::vector<int>>& cellsOfBand) const
  {
    const ProjectedTriangle triangle = this->Projected(cellId);
    if (!triangle.Drawn())
    {
      return;
    }
    if (const PixelBox box = triangle.Box(this->Margin, this->Width, this->Height); !box.Empty())
    {
      for (int band = box.YBegin / BandRows; band <= (box.YEnd - 1) / BandRows; ++band)
      {
        cellsOfBand[band].push_back(cellId);
      }
    }
  }

  ProjectedTriangle Projected(std::size_t cellId) const
  {
    const Eigen::Vector3i& t = this->Mesh.Triangles[cellId];
    return ProjectedTriangle(this->Points[t[0]], this->Points[t[1]], this->Points[t[2]]);
  }

  const TriangleMesh& Mesh;
  const Execution& Run;
  const double Margin;
  const int Width;
  const int Height;
  std::vector<ProjectedPoint> Points;
  std::array<std::vector<std::vector<int>>, Parts> CellsOfBand;
};

NOVELVIEW_CLONES void DrawTriangles(const std::vector<Eigen::Vector3i>& triangles,
  const std::vector<ProjectedPoint>& points, int width, int height, float* nearest, float* farthest)
{
  for (const Eigen::Vector3i& t : triangles)
  {
    const ProjectedTriangle triangle(points[t[0]], points[t[1]], points[t[2]]);
    if (triangle.Drawn())
    {
      TriangleDepth(triangle).Draw(triangle.Box(0, width, height), width, nearest, farthest);
    }
  }
}

/** Depths of a mesh in a picture, in one thread; `farthest` may be null. */
void DrawDepths(
  const TriangleMesh& mesh, const Camera& camera, Image<float>& nearest, Image<float>* farthest)
{
  const std::vector<ProjectedPoint> points = ProjectPoints(mesh, camera, {});
  nearest = Image<float>(camera.Width, camera.Height, 1, NoDepth);
  const std::size_t size = nearest.Values.size();
  nearest.Values.resize(size + 3);
  if (farthest)
  {
    *farthest = Image<float>(camera.Width, camera.Height, 1, 0.f);
    farthest->Values.resize(size + 3);
  }
  DrawTriangles(mesh.Triangles, points, camera.Width, camera.Height, nearest.Values.data(),
    farthest ? farthest->Values.data() : nullptr);
  nearest.Values.resize(size);
  if (farthest)
  {
    farthest->Values.resize(size);
  }
}
}

ItemBuffer Rasterise(const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
{
  ItemBuffer buffer;
  buffer.CellId = Image<int>(camera.Width, camera.Height, 1, -1);
  buffer.Depth = Image<float>(camera.Width, camera.Height, 1, NoDepth);
  const TriangleBands bands(mesh, camera, 0, execution);
  bands.ForEach(
    [&](int cellId, const ProjectedTriangle& triangle, const PixelBox& box)
    {
      const TriangleDepth depths(triangle);
      for (int y = box.YBegin; y < box.YEnd; ++y)
      {
        depths.ForRow(y, box.XBegin, box.XEnd - box.XBegin,
          [&](int i, float depth)
          {
            // Triangles come in the order of their ids, so "nearer" alone lets the lowest id win.
            if (depth < buffer.Depth(box.XBegin + i, y))
            {
              buffer.Depth(box.XBegin + i, y) = depth;
              buffer.CellId(box.XBegin + i, y) = cellId;
            }
          });
      }
    });
  return buffer;
}

Image<float> RasteriseDepth(const TriangleMesh& mesh, const Camera& camera)
{
  Image<float> depth;
  DrawDepths(mesh, camera, depth, nullptr);
  return depth;
}

DepthRange RasteriseRange(const TriangleMesh& mesh, const Camera& camera)
{
  DepthRange range;
  DrawDepths(mesh, camera, range.Nearest, &range.Farthest);
  return range;
}

SubRays RasteriseSubRays(const TriangleMesh& mesh, const Camera& camera,
  const Image<std::uint8_t>& chosen, int perSide, const Execution& execution)
{
  SubRays rays;
  rays.PerSide = perSide;
  rays.Index = Image<int>(camera.Width, camera.Height, 1, -1);
  int count = 0;
  for (std::size_t i = 0; i < chosen.Values.size(); ++i)
  {
    rays.Index.Values[i] = chosen.Values[i] ? count++ : -1;
  }
  const std::size_t perPixel = static_cast<std::size_t>(perSide) * perSide;
  rays.CellId.assign(count * perPixel, -1);
  rays.Depth.assign(count * perPixel, NoDepth);
  const TriangleBands bands(mesh, camera, 0.5, execution);
  bands.ForEach(
    [&](int cellId, const ProjectedTriangle& triangle, const PixelBox& box)
    {
      bool any = false; // of its pixels is chosen; most triangles have none
      for (int y = box.YBegin; y < box.YEnd && !any; ++y)
      {
        const std::uint8_t* row = &chosen(0, y);
        any = std::any_of(
          row + box.XBegin, row + box.XEnd, [](std::uint8_t value) { return value != 0; });
      }
      if (!any)
      {
        return;
      }
      const TriangleDepth depths(triangle);
      const auto draw = [&](int x, int y, std::size_t k)
      {
        const int column = static_cast<int>(k) % perSide;
        const int row = static_cast<int>(k) / perSide;
        const std::size_t ray = rays.Index(x, y) * perPixel + k;
        depths.ForRow(y + rays.Offset(row), x + rays.Offset(column), 1,
          [&](int, float depth)
          {
            if (depth < rays.Depth[ray])
            {
              rays.Depth[ray] = depth;
              rays.CellId[ray] = cellId;
            }
          });
      };
      for (int y = box.YBegin; y < box.YEnd; ++y)
      {
        for (int x = box.XBegin; x < box.XEnd; ++x)
        {
          for (std::size_t k = 0; k < perPixel && rays.Index(x, y) >= 0; ++k)
          {
            draw(x, y, k);
          }
        }
      }
    });
  return rays;
}

double DepthBehind(const ImageRef<const float>& depth, const Eigen::Vector2d& pixel, double z)
{
  const int x = static_cast<int>(std::lround(pixel.x()));
  const int y = static_cast<int>(std::lround(pixel.y()));
  float deepest = 0;
  for (int j = y - 1; j <= y + 1; ++j)
  {
    for (int i = x - 1; i <= x + 1; ++i)
    {
      if (depth.Contains(i, j) && std::isfinite(depth(i, j)))
      {
        deepest = std::max(deepest, depth(i, j));
      }
    }
  }
  return deepest > 0 ? z - deepest : -std::numeric_limits<double>::infinity();
}
}

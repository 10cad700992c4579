// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/Rasteriser.h"

#include "core/FunctionMultiversioning.h"
#include "core/ToInt.h"

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
  const double cut = ClampedNumber(value, 0, size);
  const int whole = static_cast<int>(cut);
  return whole + (whole < cut ? 1 : 0);
}

/** The first integer above `value`, cut to [0, size]. */
int EndPixel(double value, int size)
{
  return static_cast<int>(ClampedNumber(value + 1, 0, size));
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

/** Pictures to draw into, with up to three more pixels after the last one; null = not wanted. */
struct Pictures
{
  int Stride;
  int FirstRow; ///< of those there are
  float* Nearest;
  float* Farthest = nullptr;
  int* CellId = nullptr; ///< of the nearest
};

/** Draws a triangle's depths, four places at once. */
class TriangleDepth
{
  using Doubles [[gnu::vector_size(32)]] = double;
  using Bools [[gnu::vector_size(32)]] = std::int64_t;
  using Floats [[gnu::vector_size(16)]] = float;
  using Ints [[gnu::vector_size(16)]] = std::int32_t;

public:
  TriangleDepth(const ProjectedTriangle& triangle, int cellId)
    : TriangleDepth(triangle.P[0], triangle.P[1], triangle.P[2], triangle.Area > 0 ? 1 : -1, cellId)
  {
  }

  /** Draws the pixels of a box. */
  [[gnu::always_inline]] inline void Draw(const PixelBox& box, const Pictures& to) const
  {
    for (int y = box.YBegin; y < box.YEnd; ++y)
    {
      const Row row(*this, y);
      for (int first = box.XBegin; first < box.XEnd; first += 4)
      {
        const Doubles x = static_cast<double>(first) + Doubles{ 0, 1, 2, 3 };
        const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y - to.FirstRow) * to.Stride + first;
        this->DrawFour(row, x, x < static_cast<double>(box.XEnd), to, at);
      }
    }
  }

  /** Draws the subsamples of a pixel. */
  [[gnu::always_inline]] inline void Draw(
    int x, int y, const SubsampleGrid& grid, const Pictures& to, std::ptrdiff_t at) const
  {
    for (int j = 0; j < grid.PerSide; ++j)
    {
      const Row row(*this, y + grid.Offset[j]);
      for (int i = 0; i < grid.Stride; i += 4)
      {
        Doubles offset;
        std::memcpy(&offset, &grid.Offset[i], sizeof(offset));
        this->DrawFour(row, x + offset, Bools{} == 0, to, at + j * grid.Stride + i);
      }
    }
  }

private:
  TriangleDepth(const ProjectedPoint& a, const ProjectedPoint& b, const ProjectedPoint& c,
    double sign, int cellId)
    : Edges{ { b, c, sign }, { c, a, sign }, { a, b, sign } }
    , InverseDepth{ a.InverseDepth, b.InverseDepth, c.InverseDepth }
    , CellId(cellId)
  {
  }

  /** What the edge functions have in common over the places of one y. */
  struct Row
  {
    double W0, W1, W2;

    Row(const TriangleDepth& triangle, double y)
      : W0(triangle.Edges[0].Row(y))
      , W1(triangle.Edges[1].Row(y))
      , W2(triangle.Edges[2].Row(y))
    {
    }
  };

  [[gnu::always_inline]] inline void DrawFour(
    const Row& row, Doubles x, Bools wanted, const Pictures& to, std::ptrdiff_t at) const
  {
    const Doubles w0 = this->Edges[0].A * x + row.W0;
    const Doubles w1 = this->Edges[1].A * x + row.W1;
    const Doubles w2 = this->Edges[2].A * x + row.W2;
    const Floats depth = __builtin_convertvector((w0 + w1 + w2) /
        (w0 * this->InverseDepth[0] + w1 * this->InverseDepth[1] + w2 * this->InverseDepth[2]),
      Floats);
    const Ints covered = __builtin_convertvector((w0 >= 0) & (w1 >= 0) & (w2 >= 0) & wanted, Ints);
    Floats before;
    std::memcpy(&before, to.Nearest + at, sizeof(before));
    // Triangles come in the order of their ids, so "nearer" alone lets the lowest id win.
    const Ints nearer = covered & (depth < before);
    Floats after = nearer ? depth : before;
    std::memcpy(to.Nearest + at, &after, sizeof(after));
    if (to.CellId)
    {
      Ints ids;
      std::memcpy(&ids, to.CellId + at, sizeof(ids));
      ids = nearer ? Ints{} + this->CellId : ids;
      std::memcpy(to.CellId + at, &ids, sizeof(ids));
    }
    if (to.Farthest)
    {
      std::memcpy(&before, to.Farthest + at, sizeof(before));
      after = (covered & (depth > before)) ? depth : before;
      std::memcpy(to.Farthest + at, &after, sizeof(after));
    }
  }

  EdgeFunction Edges[3]; ///< opposite to each corner
  double InverseDepth[3];
  int CellId;
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
}

/** The triangles of a mesh, projected and sorted into bands of rows that are drawn in parallel. */
class RowTiles
{
public:
  RowTiles(const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
    : Width(camera.Width)
    , Height(camera.Height)
    , Mesh(mesh)
    , Run(execution)
    , Points(ProjectPoints(mesh, camera, execution))
  {
    execution.ForEach(Parts,
      [&](std::int64_t part)
      {
        std::vector<std::vector<Entry>>& bands = this->Bands[part];
        bands.resize(this->NumberOfBands());
        const std::size_t count = mesh.Triangles.size();
        for (std::size_t cellId = part * count / Parts; cellId < (part + 1) * count / Parts;
             ++cellId)
        {
          this->Sort(static_cast<int>(cellId), bands);
        }
      });
  }

  /**
   * Calls draw(cellId, box) for every triangle of a band in the order of their ids; box has the
   * pixels of the band of which the triangle may cover a part. A `draw` that is to be compiled with
   * its caller's clones must be inlined.
   */
  template <class Draw>
  [[gnu::always_inline]] inline void ForBand(std::int64_t band, const Draw& draw) const
  {
    for (const std::vector<std::vector<Entry>>& part : this->Bands)
    {
      for (const Entry& entry : part[band])
      {
        draw(entry.CellId, entry.Box);
      }
    }
  }

  /** Calls draw(scratch, band) for all, in parallel; make() makes the scratch of a thread. */
  template <class Make, class Draw>
  void ForEachWith(const Make& make, const Draw& draw) const
  {
    this->Run.ForEachWith(this->NumberOfBands(), make, draw);
  }

  /** Calls draw(band) for all, in parallel. */
  template <class Draw>
  void ForEach(const Draw& draw) const
  {
    this->Run.ForEach(this->NumberOfBands(), draw);
  }

  ProjectedTriangle Projected(std::size_t cellId) const
  {
    const Eigen::Vector3i& t = this->Mesh.Triangles[cellId];
    return ProjectedTriangle(this->Points[t[0]], this->Points[t[1]], this->Points[t[2]]);
  }

  static int RowBegin(std::int64_t band) { return static_cast<int>(band) * BandRows; }
  int RowEnd(std::int64_t band) const
  {
    return std::min(RowTiles::RowBegin(band) + BandRows, this->Height);
  }

  const int Width;
  const int Height;

private:
  /** The triangles are sorted in so many parts in parallel; each keeps the order of their ids. */
  static constexpr int Parts = 16;

  struct Entry
  {
    int CellId;
    PixelBox Box;
  };

  int NumberOfBands() const { return (this->Height + BandRows - 1) / BandRows; }

  void Sort(int cellId, std::vector<std::vector<Entry>>& bands) const
  {
    const ProjectedTriangle triangle = this->Projected(cellId);
    if (!triangle.Drawn())
    {
      return;
    }
    constexpr double halfPixel = 0.5;
    const PixelBox box = triangle.Box(halfPixel, this->Width, this->Height);
    for (int begin = box.YBegin, end = 0; begin < box.YEnd && !box.Empty(); begin = end)
    {
      const int band = begin / BandRows;
      end = std::min(box.YEnd, (band + 1) * BandRows);
      bands[band].push_back({ cellId, { box.XBegin, box.XEnd, begin, end } });
    }
  }

  const TriangleMesh& Mesh;
  const Execution& Run;
  std::vector<ProjectedPoint> Points;
  std::array<std::vector<std::vector<Entry>>, Parts> Bands; ///< by part and band
};

namespace
{
NOVELVIEW_CLONES void DrawBand(const RowTiles& bands, std::int64_t band, const Pictures& to)
{
  bands.ForBand(
    band, [&](int cellId, const PixelBox& around) __attribute__((always_inline)) {
      const ProjectedTriangle triangle = bands.Projected(cellId);
      PixelBox box = triangle.Box(0, bands.Width, bands.Height);
      box.YBegin = std::max(box.YBegin, around.YBegin);
      box.YEnd = std::min(box.YEnd, around.YEnd);
      TriangleDepth(triangle, cellId).Draw(box, to);
    });
}

NOVELVIEW_CLONES void DrawTriangles(const std::vector<Eigen::Vector3i>& triangles,
  const std::vector<ProjectedPoint>& points, int width, int height, float* nearest, float* farthest)
{
  for (const Eigen::Vector3i& t : triangles)
  {
    const ProjectedTriangle triangle(points[t[0]], points[t[1]], points[t[2]]);
    if (triangle.Drawn())
    {
      TriangleDepth(triangle, -1)
        .Draw(triangle.Box(0, width, height), { width, 0, nearest, farthest });
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

ProjectedMesh::ProjectedMesh(
  const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
  : Bands(std::make_unique<const RowTiles>(mesh, camera, execution))
{
}

ProjectedMesh::~ProjectedMesh() = default;

ItemBuffer ProjectedMesh::Rasterise() const
{
  const int width = this->Bands->Width;
  const int height = this->Bands->Height;
  ItemBuffer buffer{ Image<int>(width, height), Image<float>(width, height) };
  // A band is drawn where it stays in the cache, wider by what Draw() may touch after a row.
  const auto makeBand = [stride = width + 3] {
    return ItemBuffer{ Image<int>(stride, BandRows), Image<float>(stride, BandRows) };
  };
  this->Bands->ForEachWith(makeBand,
    [&](ItemBuffer& drawn, std::int64_t band)
    {
      std::fill(drawn.CellId.Values.begin(), drawn.CellId.Values.end(), -1);
      std::fill(drawn.Depth.Values.begin(), drawn.Depth.Values.end(), NoDepth);
      const int begin = RowTiles::RowBegin(band);
      DrawBand(*this->Bands, band,
        { drawn.Depth.Width, begin, drawn.Depth.Values.data(), nullptr,
          drawn.CellId.Values.data() });
      for (int y = begin; y < this->Bands->RowEnd(band); ++y)
      {
        std::copy_n(&drawn.CellId(0, y - begin), width, &buffer.CellId(0, y));
        std::copy_n(&drawn.Depth(0, y - begin), width, &buffer.Depth(0, y));
      }
    });
  return buffer;
}

ItemBuffer Rasterise(const TriangleMesh& mesh, const Camera& camera, const Execution& execution)
{
  return ProjectedMesh(mesh, camera, execution).Rasterise();
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

namespace
{
/** Whether a box has a chosen pixel. */
[[gnu::always_inline]] inline bool AnyIn(const PixelBox& box, const Image<std::uint8_t>& chosen)
{
  std::uint8_t any = 0;
  for (int y = box.YBegin; y < box.YEnd; ++y)
  {
    for (int x = box.XBegin; x < box.XEnd; ++x)
    {
      any |= chosen(x, y);
    }
  }
  return any != 0;
}

NOVELVIEW_CLONES void DrawBandSubRays(
  const RowTiles& bands, std::int64_t band, const Image<std::uint8_t>& chosen, Subsamples& rays)
{
  const Pictures to{ 0, 0, rays.Depth.data(), nullptr, rays.CellId.data() };
  bands.ForBand(
    band, [&](int cellId, const PixelBox& box) __attribute__((always_inline)) {
      if (!AnyIn(box, chosen)) // as is usual
      {
        return;
      }
      const TriangleDepth triangle(bands.Projected(cellId), cellId);
      for (int y = box.YBegin; y < box.YEnd; ++y)
      {
        for (int x = box.XBegin; x < box.XEnd; ++x)
        {
          if (chosen(x, y))
          {
            triangle.Draw(x, y, rays.Grid, to, rays.First(x, y));
          }
        }
      }
    });
}
}

Subsamples ProjectedMesh::RasteriseSubsamples(const Image<std::uint8_t>& chosen, int perSide) const
{
  Subsamples rays(chosen, perSide);
  this->Bands->ForEach(
    [&](std::int64_t band) { DrawBandSubRays(*this->Bands, band, chosen, rays); });
  return rays;
}

SubsampleGrid::SubsampleGrid(int perSide)
  : PerSide(perSide)
  , Stride((perSide + 3) / 4 * 4)
  , Offset(this->Stride, std::numeric_limits<double>::quiet_NaN())
{
  for (int i = 0; i < perSide; ++i)
  {
    this->Offset[i] = (i + 0.5) / perSide - 0.5;
  }
}

Subsamples::Subsamples(const Image<std::uint8_t>& chosen, int perSide)
  : Grid(perSide)
  , Index(chosen.Width, chosen.Height, 1, -1)
{
  for (std::size_t i = 0; i < chosen.Values.size(); ++i)
  {
    if (chosen.Values[i])
    {
      this->Index.Values[i] = this->Pixels++;
    }
  }
  const std::size_t size = static_cast<std::size_t>(this->Pixels) * perSide * this->Grid.Stride;
  this->CellId.assign(size, -1);
  this->Depth.assign(size, NoDepth);
}

namespace
{
/** The integer nearest to a value; the one above from half-way. */
int NearestPixel(double value)
{
  const int whole = static_cast<int>(value + 0.5);
  return whole - (whole > value + 0.5 ? 1 : 0);
}

/** The deepest of the 3x3 pixels around one, of those inside the image; 0 = none has a depth. */
float DeepestAround(const ImageRef<const float>& depth, int x, int y)
{
  using Floats [[gnu::vector_size(16)]] = float;
  if (depth.Contains(x - 1, y - 1) && depth.Contains(x + 2, y + 1)) // a row is read as four
  {
    Floats deepest{};
    for (int j = -1; j <= 1; ++j)
    {
      Floats row;
      std::memcpy(&row, depth.Pixel(x - 1, y + j), sizeof(row));
      row = row < NoDepth ? row : Floats{};
      deepest = deepest > row ? deepest : row;
    }
    return std::max({ deepest[0], deepest[1], deepest[2] });
  }
  float deepest = 0;
  for (int j = y - 1; j <= y + 1; ++j)
  {
    for (int i = x - 1; i <= x + 1; ++i)
    {
      const float value = depth.Contains(i, j) ? depth(i, j) : 0;
      deepest = std::max(deepest, value < NoDepth ? value : 0.f);
    }
  }
  return deepest;
}
}

double OcclusionDepth(const ImageRef<const float>& depth, const Eigen::Vector2d& pixel, double z)
{
  if (!(pixel.x() > -2 && pixel.y() > -2 && pixel.x() < depth.Width + 1 &&
        pixel.y() < depth.Height + 1))
  {
    return -std::numeric_limits<double>::infinity();
  }
  const float deepest = DeepestAround(depth, NearestPixel(pixel.x()), NearestPixel(pixel.y()));
  return deepest > 0 ? z - deepest : -std::numeric_limits<double>::infinity();
}
}

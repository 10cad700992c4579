// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the rasteriser: the depths of a triangle. To be inlined into functions with clones.
#ifndef novelview_TriangleDepth_h
#define novelview_TriangleDepth_h

#include "geometry/PixelBox.h"
#include "geometry/ProjectedTriangle.h"
#include "geometry/Subsamples.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace novelview
{
/** Images to draw into, with up to three more pixels after the last one; null = not wanted. */
struct RasterTarget
{
  int Stride;
  int FirstRow; ///< of those there are
  float* Nearest;
  float* Farthest = nullptr;
  int* CellId = nullptr; ///< of the nearest
};

/** Draws a triangle's depths, four pixels at a time. */
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
  [[gnu::always_inline]] inline void Draw(const PixelBox& box, const RasterTarget& to) const
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
    int x, int y, const SubsampleGrid& grid, const RasterTarget& to, std::ptrdiff_t at) const
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
    const Row& row, Doubles x, Bools wanted, const RasterTarget& to, std::ptrdiff_t at) const
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
}

#endif

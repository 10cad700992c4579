// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/CoveredBuffer.h"

#include "core/FunctionMultiversioning.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace novelview
{
namespace
{
/** Joins a row of triangle ids to two rows of marks: hit in any row so far, hit in all. */
NOVELVIEW_CLONES void JoinHits(const int* cellIds, int width, std::uint8_t* any, std::uint8_t* all)
{
  for (int x = 0; x < width; ++x)
  {
    const std::uint8_t hit = cellIds[x] >= 0;
    any[x] |= hit;
    all[x] &= hit;
  }
}

/** Marks pixels of which, with the two neighbours in the row, some are hit but not all. */
NOVELVIEW_CLONES void MarkRim(
  const std::uint8_t* any, const std::uint8_t* all, int width, std::uint8_t* rim)
{
  for (int x = 0; x < width; ++x)
  {
    rim[x] = (any[x - 1] | any[x] | any[x + 1]) & ((all[x - 1] & all[x] & all[x + 1]) ^ 1);
  }
}

/** The pixels at the border between object and background: some of the 3x3 are hit, some not. */
Image<std::uint8_t> RimPixels(const ItemBuffer& front, const Execution& execution)
{
  const int width = front.CellId.Width;
  const int height = front.CellId.Height;
  Image<std::uint8_t> rim(width, height);
  struct Rows
  {
    std::vector<std::uint8_t> Any; ///< hit in the row or one of those next to it
    std::vector<std::uint8_t> All; ///< hit in all of them
  };
  execution.ForEachWith(
    height, [] { return Rows(); },
    [&](Rows& rows, std::int64_t row)
    {
      const int y = static_cast<int>(row);
      // With a column more on both sides, of which nothing follows.
      rows.Any.assign(width + 2, 0);
      rows.All.assign(width + 2, 1);
      for (int j = std::max(y - 1, 0); j <= std::min(y + 1, height - 1); ++j)
      {
        JoinHits(&front.CellId(0, j), width, &rows.Any[1], &rows.All[1]);
      }
      MarkRim(&rows.Any[1], &rows.All[1], width, &rim(0, y));
    });
  return rim;
}

/** Settles a rim pixel by its subsamples. */
void CoverRimPixel(CoveredBuffer& buffer, int x, int y)
{
  const Subsamples& rays = buffer.Rays;
  const int perSide = rays.Grid.PerSide;
  const int middle = perSide / 2;
  RimCoverage& rim = buffer.Rim[rays.Index(x, y)];
  int hits = 0;
  int nearest = std::numeric_limits<int>::max();
  buffer.Front.CellId(x, y) = -1;
  for (int row = 0; row < perSide; ++row)
  {
    const std::size_t first = rays.First(x, y) + row * rays.Grid.Stride;
    for (int column = 0; column < perSide; ++column)
    {
      if (rays.CellId[first + column] < 0)
      {
        continue;
      }
      ++hits;
      const int i = column - middle;
      const int j = row - middle;
      if (i * i + j * j < nearest)
      {
        nearest = i * i + j * j;
        buffer.Front.CellId(x, y) = rays.CellId[first + column];
        buffer.Front.Depth(x, y) = rays.Depth[first + column];
        rim.Column = column;
        rim.Row = row;
      }
    }
  }
  rim.Covered = static_cast<float>(hits) / (perSide * perSide);
}
}

CoveredBuffer RasteriseCovered(
  const TriangleMesh& mesh, const Camera& camera, int samples, const Execution& execution)
{
  const ProjectedMesh inFrame(mesh, camera, execution);
  ItemBuffer front = inFrame.Rasterise();
  const Image<std::uint8_t> rim =
    samples > 1 ? RimPixels(front, execution) : Image<std::uint8_t>(camera.Width, camera.Height);
  CoveredBuffer result{ std::move(front), inFrame.RasteriseSubsamples(rim, samples), {} };
  result.Rim.resize(result.Rays.Pixels);
  execution.ForEach(camera.Height,
    [&](std::int64_t row)
    {
      const int y = static_cast<int>(row);
      for (int x = 0; x < camera.Width; ++x)
      {
        if (rim(x, y))
        {
          CoverRimPixel(result, x, y);
        }
      }
    });
  return result;
}
}

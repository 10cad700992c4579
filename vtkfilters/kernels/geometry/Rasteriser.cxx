// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/Rasteriser.h"

#include "core/FunctionMultiversioning.h"
#include "geometry/RowTiles.h"
#include "geometry/TriangleDepth.h"

#include <algorithm>

namespace novelview
{
namespace
{
NOVELVIEW_CLONES void DrawBand(const RowTiles& bands, std::int64_t band, const RasterTarget& to)
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

NOVELVIEW_CLONES void DrawBandSubsamples(
  const RowTiles& bands, std::int64_t band, const Image<std::uint8_t>& chosen, Subsamples& rays)
{
  const RasterTarget to{ 0, 0, rays.Depth.data(), nullptr, rays.CellId.data() };
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
  const auto makeBand = [stride = width + 3]
  {
    return ItemBuffer{ Image<int>(stride, RowTiles::BandRows),
      Image<float>(stride, RowTiles::BandRows) };
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

Subsamples ProjectedMesh::RasteriseSubsamples(const Image<std::uint8_t>& chosen, int perSide) const
{
  Subsamples rays(chosen, perSide);
  this->Bands->ForEach(
    [&](std::int64_t band) { DrawBandSubsamples(*this->Bands, band, chosen, rays); });
  return rays;
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the texture atlas: which triangles lie together in its picture, and where.
#ifndef novelview_AtlasCharts_h
#define novelview_AtlasCharts_h

#include "core/Execution.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "texture/PhotoBlender.h"
#include "texture/TextureAtlasOptions.h"

#include <vector>

namespace novelview
{
/** Connected triangles as one photograph shows them, in a rectangle of the atlas. */
struct AtlasChart
{
  int View = 0;           ///< whose pixels are the texture coordinates
  std::vector<int> Cells; ///< ids of its triangles, ascending
  Eigen::Vector2d Origin; ///< pixel of the photograph, scaled, at the rectangle's texel (0, 0)
  int X = 0;              ///< of the rectangle in the atlas, texels
  int Y = 0;
  int Width = 0; ///< with the padding
  int Height = 0;
};

struct AtlasLayout
{
  const std::vector<View>& Views;
  std::vector<AtlasChart> Charts;
  double Scale = 1; ///< texels per pixel of the photographs
  int PaddingPx = 0;
  int Width = 0;
  int Height = 0;

  /** Where a point lies in a chart's rectangle, texels; texel centres on integers. */
  Eigen::Vector2d InChart(const AtlasChart& chart, const Eigen::Vector3d& point) const
  {
    return this->Scale * this->Views[chart.View].Cam.Project(point) - chart.Origin;
  }
};

/** Steps 1 to 3 of MakeTextureAtlas(). The references are those of all views, in their order. */
AtlasLayout LayOutCharts(const TriangleMesh& mesh, const std::vector<BlendReference>& references,
  const std::vector<View>& views, const TextureAtlasOptions& options, const Execution& execution);
}

#endif

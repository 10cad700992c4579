// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TextureAtlas_h
#define novelview_TextureAtlas_h

#include "core/Execution.h"
#include "core/ImageRef.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "texture/TextureAtlasOptions.h"

#include <array>
#include <cstdint>
#include <vector>

namespace novelview
{
/** A mesh cut into charts with a picture for all of them. */
struct TextureAtlas
{
  TriangleMesh Mesh; ///< the input's triangles in their order; points at seams are there twice
  std::vector<int> PointOf;               ///< which of the input's points each is
  std::vector<Eigen::Vector2d> TexCoords; ///< per point: 0 to 1, (0, 0) = top left of the picture
  Image<std::uint8_t> Picture;            ///< RGB
  int Charts = 0;
  double SeenShare = 0; ///< part of the charts' texels that a photograph sees
  double UsedShare = 0; ///< part of the picture that charts cover, without their padding
  double Scale = 1;     ///< texels per photograph pixel
};

/**
 * Colours of the points (RGB): as PhotoBlender has them, seen along the inward normal. What no
 * photograph sees takes the mean of its neighbours, layer by layer; grey where there are none.
 */
std::vector<std::array<std::uint8_t, 3>> ColourPoints(const TriangleMesh& mesh,
  const std::vector<View>& views, const TextureOptions& options, const Execution& execution = {});

/**
 * A texture atlas from the photographs.
 *
 *  1. Every triangle is given to the photograph that shows it in the most pixels, and straightest:
 *     quality = projected area x cosine of incidence, as part of the best; 0 when a corner or the
 *     middle is hidden or outside the silhouette. Neighbours in the same photograph count Loyalty
 *     each, so that charts become large (iterated conditional modes).
 *  2. Connected triangles of one photograph are a chart; its texture coordinates are the pixels of
 *     that photograph. What no photograph sees makes charts of its own, in the one it faces most.
 *  3. Charts are packed in rows, tallest first, around each a padding.
 *  4. Every texel's surface point is coloured from all photographs that see it (PhotoBlender, seen
 *     along the inward normal), so that charts match at their seams. Texels that none sees take the
 *     points' colours.
 *
 * Views need Color and ContourDistance. Throws Error when the mesh has no triangles or the charts do
 * not fit at any sensible scale.
 */
TextureAtlas MakeTextureAtlas(const TriangleMesh& mesh, const std::vector<View>& views,
  const TextureAtlasOptions& options = {}, const Execution& execution = {});
}

#endif

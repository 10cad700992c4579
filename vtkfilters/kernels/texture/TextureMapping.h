// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TextureMapping_h
#define novelview_TextureMapping_h

#include "core/Execution.h"
#include "geometry/Rasteriser.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "texture/TextureParameters.h"

#include <cstdint>
#include <vector>

namespace novelview
{
struct TextureOptions
{
  /** Photographs blended per pixel, the nearest in viewing direction that see the point. */
  int References = TextureParameters::References.Default;
  /** m of the weight W^m. */
  double Power = TextureParameters::Power.Default;
  /**
   * A photograph counts in full where the point projects this far inside its silhouette, and falls
   * to nothing at BorderPx, so that no background bleeds in: bilinear interpolation reads pixels up
   * to sqrt(2) away, which must all be inside. Pixels.
   */
  double FeatherPx = TextureParameters::FeatherPx.Default;
  double BorderPx = 1.5;
  /**
   * Softness of the occlusion test: a point that lies z deeper than what the reference sees there
   * counts exp(-(z / (OcclusionPx footprints))^2); 0 tests hard at one and a half footprints.
   */
  double OcclusionPx = TextureParameters::OcclusionPx.Default;
  /**
   * Test occlusion against the views' own DepthMap where they have one, rather than against the
   * model rasterised into the reference.
   */
  bool UseDepthMaps = TextureParameters::UseDepthMaps;
  /** Divide colours by the views' Gain. */
  bool UseGains = TextureParameters::UseGains;
  /** Subsamples per pixel side that decide a boundary pixel's coverage, odd; 1 = no antialiasing. */
  int BoundarySamples = TextureParameters::BoundarySamples.Default;
  /**
   * Draw also the pixels of which less than half is covered, so that a contour that moves by less
   * than a pixel changes the picture by little; Mask, Depth, CellId and Seen remain without them.
   */
  bool SoftBoundary = TextureParameters::SoftBoundary;
};

/** The novel picture and what is known about each of its pixels; rows from the top. */
struct TexturedView
{
  /** RGB, black where Mask is 0 (but see SoftBoundary); multiplied by the coverage at the boundary. */
  Image<std::uint8_t> Color;
  Image<std::uint8_t> Mask; ///< 255 = object
  Image<float> Depth;       ///< z of the surface point, 0 where Mask is 0
  Image<int> CellId;        ///< triangle of the mesh, -1 where Mask is 0
  Image<std::uint8_t> Seen; ///< 1 = a reference sees the point, 0 = filled from the surroundings
};

/** Whether the model decides what a photograph sees, of some photograph at least. */
bool NeedsModel(const std::vector<View>& views, const TextureOptions& options);

/**
 * View-dependent image synthesis (Chia et al. 2013, section 3). The mesh lookup table gives every
 * pixel of `camera` its surface point V; its colour is
 *
 *     sum W_c^m I_c(project(V)) / sum W_c^m
 *
 * over the nearest references that see V, W_c being the cosine between the novel and the reference
 * viewing ray. Visible means: not deeper than the depth of `mesh` and `occluders` rasterised into
 * the reference. Pixels no reference sees take the mean of their filled neighbours, layer by layer.
 *
 * @param occluders what else stands between the references and the mesh; may be null, and is not
 *        looked at unless NeedsModel().
 */
TexturedView TextureView(const TriangleMesh& mesh, const TriangleMesh* occluders,
  const std::vector<View>& views, const Camera& camera, const TextureOptions& options = {},
  const Execution& execution = {});
}

#endif

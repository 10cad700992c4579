// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_TextureOptions_h
#define novelview_TextureOptions_h

#include "texture/TextureParameters.h"

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
}

#endif

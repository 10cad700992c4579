// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of TextureView(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_TextureOptions_h
#define novelview_TextureOptions_h

#include "core/Parameter.h"

namespace novelview
{
struct TextureOptions
{
  /** Photographs blended per pixel, the nearest in viewing direction that see the point. */
  static constexpr Parameter<int> ReferencesParameter{ 3, 1, 64 };
  int References = ReferencesParameter.Default;
  /** m of the weight W^m. */
  static constexpr Parameter<double> PowerParameter{ 8, 0, 64 };
  double Power = PowerParameter.Default;
  /**
   * A photograph counts in full where the point projects this far inside its silhouette, and falls
   * to nothing at BorderPx, so that no background bleeds in: bilinear interpolation reads pixels up
   * to sqrt(2) away, which must all be inside. Pixels.
   */
  static constexpr Parameter<double> FeatherPxParameter{ 2, 0.01, 100, "px" };
  double FeatherPx = FeatherPxParameter.Default;
  double BorderPx = 1.5;
  /**
   * Softness of the occlusion test: a point that lies z deeper than what the reference sees there
   * counts exp(-(z / (OcclusionPx footprints))^2); 0 tests hard at one and a half footprints.
   */
  static constexpr Parameter<double> OcclusionPxParameter{ 0, 0, 100, "pixel footprints" };
  double OcclusionPx = OcclusionPxParameter.Default;
  /**
   * Test occlusion against the views' own DepthMap where they have one, rather than against the
   * model rasterised into the reference.
   */
  bool UseDepthMaps = false;
  /**
   * Pixels whose references look from further aside than the second nearest photograph by this much
   * take their level from the surroundings (FarPixels.h); 0 = none.
   */
  static constexpr Parameter<double> FarDegParameter{ 0, 0, 90, "deg" };
  double FarDeg = FarDegParameter.Default;
  /** Divide colours by the views' Gain. */
  bool UseGains = false;
  /** Subsamples per pixel side that decide a boundary pixel's coverage, odd; 1 = no antialiasing. */
  static constexpr Parameter<int> BoundarySamplesParameter{ 1, 1, 9 };
  int BoundarySamples = BoundarySamplesParameter.Default;
  /**
   * Draw also the pixels of which less than half is covered, so that a contour that moves by less
   * than a pixel changes the picture by little; Mask, Depth, CellId and Seen remain without them.
   */
  bool SoftBoundary = false;
};
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SynthesisOptions_h
#define novelview_SynthesisOptions_h

#include "deformation/DeformationParameters.h"
#include "fusion/FusionParameters.h"
#include "geometry/VisibilityParameters.h"
#include "hull/VisualHullParameters.h"
#include "options/Options.h"
#include "texture/TextureParameters.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>

namespace novelview
{
/** How far the geometry is refined before it is textured. */
enum class Stage
{
  Hull,
  Outline,
  Full
};

/** "hull", "outline" or "full". */
std::string StageName(Stage stage);

/**
 * Every option of the method. Lengths in pixels are pixels of the photographs or the novel view.
 * Defaults are the paper's, and those of the kernels and filters.
 */
struct SynthesisOptions
{
  /** "best" or "paper": which defaults the other members start from, see PresetOptions(). */
  std::string Preset = "best";

  /** Folder that keeps what does not depend on the novel camera (StageCache); empty = none. */
  std::filesystem::path Cache;

  // ---- cameras
  /** Correct their poses where photographs agree on it; needs depth maps. */
  bool RefineCameras = false;

  // ---- silhouettes
  bool ReconcileSilhouettes = false; ///< enlarge those that are too small for all the others
  bool RepairSilhouettes = false;    ///< add parts that most of the others show

  // ---- hull
  /** Sample spacing, input pixels. */
  double HullSpacingPx = VisualHullParameters::SpacingPx.Default;
  /** x0 y0 z0 x1 y1 z1; found when not given. */
  std::optional<std::array<double, 6>> HullBox;
  /** Keep every component, not only the largest. */
  bool HullKeepAll = VisualHullParameters::KeepAllComponents;

  // ---- visibility culler
  /** Cut longer edges of what the camera sees at their middle; 0 = none. */
  double LongestEdgePx = VisibilityParameters::LongestEdgePx.Default;

  // ---- outline deformer
  int OutlineIterations = DeformationParameters::Iterations.Default;
  /** Weight of the contour energy. */
  double OutlineAlpha = OutlineParameters::Alpha.Default;
  /** Weight of the smoothness energy. */
  double OutlineBeta = OutlineParameters::Beta.Default;
  double OutlineSearchPx = OutlineParameters::SearchPx.Default;

  // ---- non-outline deformer
  int NonOutlineIterations = DeformationParameters::Iterations.Default;
  /** Weight of the smoothness energy. */
  double NonOutlineAlpha = NonOutlineParameters::Alpha.Default;

  // ---- depth maps of the photographs
  /** Estimate them, and let deformers and mapper use them. */
  bool UseDepthMaps = TextureParameters::UseDepthMaps;
  /** Weight of "object" when they decide the outline; 0 = found. */
  double SilhouettePrior = FusionParameters::SilhouettePrior.Default;
  /** By how much they are off, pixel footprints; 0 = measured. */
  double DepthNoise = FusionParameters::DepthNoise.Default;
  /** Refine the outline by the photographs' contours. */
  bool ContourPrediction = FusionParameters::UsePrediction;

  // ---- texture mapper
  /** Photographs blended per pixel. */
  int References = TextureParameters::References.Default;
  /** m of the weight W^m. */
  double Power = TextureParameters::Power.Default;
  /** A photograph's weight grows over this from its contour inwards. */
  double FeatherPx = TextureParameters::FeatherPx.Default;
  /** Pixel footprints; 0 = hard. */
  double OcclusionSoftness = TextureParameters::OcclusionPx.Default;
  /** Bring the photographs to one exposure; needs depth maps. */
  bool ExposureGains = TextureParameters::UseGains;
  /** Subsamples per pixel side at the silhouette boundary; 1 = no antialiasing. */
  int BoundarySamples = TextureParameters::BoundarySamples.Default;
  /** Also draw pixels of which less than half is covered; for films. */
  bool SoftBoundary = TextureParameters::SoftBoundary;
};

/** The defaults of a preset; throws Error on an unknown name. */
SynthesisOptions PresetOptions(const std::string& preset);

/** The table of all of them: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(SynthesisOptions& options);

/** The option "stage". */
Option StageOption(Stage& upTo);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SynthesisOptions_h
#define novelview_SynthesisOptions_h

#include "options/Options.h"

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

/** Every knob of the method. Lengths in pixels are pixels of the photographs or the novel view. */
struct SynthesisOptions
{
  /** "best" or "paper": which defaults the other members start from, see PresetOptions(). */
  std::string Preset = "best";

  /** Folder that keeps what does not depend on the novel camera (StageCache); empty = none. */
  std::filesystem::path Cache;

  // ---- silhouettes
  bool ReconcileSilhouettes = false; ///< enlarge those that are too small for all the others

  // ---- hull
  double HullSpacingPx = 2.0;                   ///< sample spacing, input pixels
  std::optional<std::array<double, 6>> HullBox; ///< x0 y0 z0 x1 y1 z1; found when not given
  bool HullKeepAll = false;                     ///< keep every component, not only the largest

  // ---- visibility culler
  double LongestEdgePx = 0; ///< cut longer edges of what the camera sees at their middle; 0 = none

  // ---- outline deformer
  int OutlineIterations = 10;
  double OutlineAlpha = 0.3; ///< weight of the contour energy
  double OutlineBeta = 0.3;  ///< weight of the smoothness energy
  double OutlineSearchPx = 4.0;

  // ---- non-outline deformer
  int NonOutlineIterations = 10;
  double NonOutlineAlpha = 0.3; ///< weight of the smoothness energy

  // ---- depth maps of the photographs
  bool UseDepthMaps = false;      ///< estimate them, and let deformers and mapper use them
  double SilhouettePrior = 0;     ///< weight of "object" when they decide the outline; 0 = found
  double DepthNoise = 0;          ///< by how much they are off, pixel footprints; 0 = measured
  bool ContourPrediction = false; ///< refine the outline by the photographs' contours

  // ---- texture mapper
  int References = 3;           ///< photographs blended per pixel
  double Power = 8.0;           ///< m of the weight W^m
  double FeatherPx = 2.0;       ///< a photograph's weight grows over this from its contour inwards
  double OcclusionSoftness = 0; ///< pixel footprints; 0 = hard
  bool ExposureGains = false;   ///< bring the photographs to one exposure; needs depth maps
  int RimSamples = 1;           ///< subsamples per pixel side at the rim; 1 = no antialiasing
  bool SoftRim = false;         ///< also draw pixels of which less than half is covered; for films
};

/** The defaults of a preset; throws Error on an unknown name. */
SynthesisOptions PresetOptions(const std::string& preset);

/** The table of all of them: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(SynthesisOptions& options);

/** The option "stage". */
Option StageOption(Stage& upTo);
}

#endif

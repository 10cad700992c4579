// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SynthesisOptions_h
#define novelview_SynthesisOptions_h

#include "deformation/DeformationOptions.h"
#include "fusion/DepthMapOptions.h"
#include "geometry/VisibilityOptions.h"
#include "hull/VisualHullOptions.h"
#include "options/Options.h"
#include "texture/TextureOptions.h"

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
/** The stage of a name; nothing when it is none. */
std::optional<Stage> StageOfName(const std::string& name);

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

  // ---- the kernels' options
  VisualHullOptions Hull;
  VisibilityOptions Culler;
  OutlineOptions Outline;       ///< Iterations also without depth maps
  NonOutlineOptions NonOutline; ///< the same
  TextureOptions Texture;       ///< UseDepthMaps is the one below

  // ---- depth maps of the photographs
  /** Estimate them, and let deformers and mapper use them. */
  bool UseDepthMaps = false;
  DepthMapOptions DepthMaps;
};

/** The defaults of a preset; throws Error on an unknown name. */
SynthesisOptions PresetOptions(const std::string& preset);

/** The table of all of them: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(SynthesisOptions& options);

/** The option "stage". */
Option StageOption(Stage& upTo);
}

#endif

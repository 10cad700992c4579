// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_MaskOptions_h
#define novelview_MaskOptions_h

#include "commands/MethodOptions.h"
#include "dataset/DatasetInput.h"
#include "masks/GrabCutMask.h"
#include "options/Options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** Silhouettes for the photographs of a folder: `novelview mask`. */
struct MaskOptions
{
  std::filesystem::path Dataset;    ///< folder; without a calibration all its photographs are meant
  DatasetSource Source;             ///< its calibration
  std::vector<std::string> Exclude; ///< photographs to leave out
  std::filesystem::path Out;        ///< gets mask/ and the contact sheet; empty with InPlace
  bool InPlace = false;             ///< write into the data set's own mask/
  bool Overwrite = false;           ///< replace masks that are there
  std::string Method = "auto";      ///< auto, alpha, plain, dark, chroma or grabcut
  std::vector<double> Key;          ///< chroma: the background's RGB, 0 to 255; empty = found
  std::vector<double> Box;          ///< grabcut: x0 y0 x1 y1 around the object, px; empty = central
  double BoxMargin = 0.1;           ///< of the central box to every side, part of the frame
  int GrabCutRounds = GrabCutOptions().Rounds;
  SilhouetteOptions Silhouette;
  int Threads = ProgramParameters::Threads.Default;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(MaskOptions& options);

/**
 * The options; they come from the command line alone. Throws UsageError, also when options contradict
 * each other.
 */
MaskOptions MakeMaskOptions(const std::filesystem::path& dataset, const ParsedArguments& given,
  const OptionWarning& warn = {});
}

#endif

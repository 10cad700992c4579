// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ConvertOptions_h
#define novelview_ConvertOptions_h

#include "commands/MethodOptions.h"
#include "dataset/DatasetInput.h"
#include "options/Options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** A data set in another format: `novelview convert`. */
struct ConvertOptions
{
  std::filesystem::path Dataset;    ///< folder
  DatasetSource Source;             ///< its calibration
  std::filesystem::path Out;        ///< another folder
  std::string Format;               ///< a name of DatasetFormats.h
  std::vector<std::string> Exclude; ///< photographs to leave out
  bool RefineCameras = false;       ///< write poses with which the photographs agree better
  bool Undistort = false;           ///< also where the format can represent the distortion
  int Threads = ProgramParameters::Threads.Default;
};

/** The table: what the options are called, their help, units and ranges. */
OptionTable OptionsOf(ConvertOptions& options);

/** The options of a conversion; they come from the command line alone. Throws UsageError. */
ConvertOptions MakeConvertOptions(const std::filesystem::path& dataset,
  const ParsedArguments& given, const OptionWarning& warn = {});
}

#endif

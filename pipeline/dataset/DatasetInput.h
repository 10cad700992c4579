// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_DatasetInput_h
#define novelview_DatasetInput_h

#include "dataset/Dataset.h"
#include "masks/Silhouette.h"
#include "options/Options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/** The photographs and how they are read. */
struct DatasetInput
{
  std::filesystem::path Dataset;    ///< folder
  DatasetSource Source;             ///< its calibration
  std::vector<std::string> Exclude; ///< photographs to leave out
  bool ForceSilhouettes = false;    ///< extract silhouettes although there are masks
  std::optional<double> MaxSize;    ///< see LimitSize()
  SilhouetteOptions Silhouette;
};

/** The calibration's options; `formatKey` is the key of the format in the command. */
OptionTable OptionsOf(DatasetSource& source, const char* formatKey);

/** How silhouettes are taken from photographs. */
OptionTable OptionsOf(SilhouetteOptions& silhouette);

/** All of an input. */
OptionTable OptionsOf(DatasetInput& input);
}

#endif

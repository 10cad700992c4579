// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/OrbitOptions.h"

namespace novelview
{
namespace fs = std::filesystem;

OptionTable OptionsOf(OrbitOptions& options)
{
  const char* const orbit = "Orbit";
  OptionTable table = {
    { "out", "video (mp4, mov, mkv, avi), or folder for the frames as pictures", "", orbit,
      &options.Out },
    { "path", "JSON file of key cameras to go through; else once round the cameras' ring", "",
      orbit, &options.Path },
    { "frames", "frames; 0 = as many as the path's frame numbers or times give, else 72", "", orbit,
      &options.Frames, 0, 1000000 },
    { "fps", "frames per second", "1/s", orbit, &options.Fps, 0.1, 1000 },
    { "framesDir", "folder that gets the frames as pictures, too, with their cameras", "", orbit,
      &options.FramesDir },
  };
  table = WithMethod(std::move(table), options);
  table.push_back(RankTimeoutOption(options.RankTimeoutSeconds));
  return table;
}

SynthesisOptions OrbitOptions::DefaultsOf(const std::string& preset)
{
  SynthesisOptions options = PresetOptions(preset);
  options.Texture.SoftBoundary = true;
  options.Texture.BoundarySamples = 5;
  return options;
}

OrbitOptions MakeOrbitOptions(
  const fs::path& dataset, const ParsedArguments& given, const OptionWarning& warn)
{
  return MergedOptions<OrbitOptions>(dataset, given, warn);
}
}

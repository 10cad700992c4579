// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset/DatasetInput.h"

#include "cameras/CameraLimits.h"
#include "formats/DatasetFormats.h"

namespace novelview
{
OptionTable OptionsOf(DatasetSource& source, const char* formatKey)
{
  const char* const group = "Calibration";
  CameraConvention& convention = source.Convention;
  std::vector<std::string> formats = DatasetFormatNames();
  formats.insert(formats.begin(), "auto");
  return {
    { "calibration", "calibration file (COLMAP: also its folder); detected if there is just one",
      "", group, &source.Calibration },
    { formatKey, "format of the calibration; auto = detected", "", group, &source.Format,
      -Unlimited, Unlimited, formats },
    { "axes", "camera's axes: x right, y down, z forward, or x right, y up, z backward", "", group,
      &convention.Axes, -Unlimited, Unlimited, { "format", "opencv", "opengl" } },
    { "poses", "what the poses map", "", group, &convention.Poses, -Unlimited, Unlimited,
      { "format", "world-to-camera", "camera-to-world" } },
    { "rotationOrder", "how rotations are written: row by row, or transposed", "", group,
      &convention.RotationOrder, -Unlimited, Unlimited, { "format", "row", "column" } },
    { "pixelCentre", "coordinate of the centre of the top-left pixel; the format's when not given",
      "px", group, &convention.PixelCentre, 0, 0.5 },
    { "flipY", "y of cameras and pixels points up; a left-handed world is mirrored", "", group,
      &convention.FlipY },
    { "invertMasks", "the object is black in the masks", "", group, &convention.InvertMasks },
    { "exifOrientation",
      "whether photographs are turned as their EXIF data say; auto = as the calibration needs", "",
      group, &source.ExifOrientation, -Unlimited, Unlimited, { "auto", "ignore", "apply" } },
    { "whiteLevel", "value of white in photographs of more than 8 bits; the file's when not given",
      "", group, &source.WhiteLevel, 0, 65535 },
  };
}

OptionTable OptionsOf(SilhouetteOptions& silhouette)
{
  const char* const group = "Photographs";
  return {
    { "silhouetteLevel",
      "difference from the background that is object; chosen from the photograph when not given",
      "levels", group, &silhouette.Level, 0, 255 },
    { "silhouetteClosing", "gaps of up to twice this are closed", "px", group,
      &silhouette.ClosingPx, 0, 100 },
    { "silhouetteSmallHole", "smaller holes are filled", "part of the object", group,
      &silhouette.SmallHole, 0, 1 },
    { "silhouetteIgnoreShadows", "leave out shadows cast on a coloured background", "", group,
      &silhouette.IgnoreShadows },
  };
}

OptionTable OptionsOf(DatasetInput& input)
{
  const char* const group = "Photographs";
  OptionTable table = {
    { "dataset", "folder of the photographs", "", group, &input.Dataset },
    { "exclude", "photographs to leave out", "", group, &input.Exclude },
    { "forceSilhouettes", "extract silhouettes although there are masks", "", group,
      &input.ForceSilhouettes },
    { "maxSize",
      "longer side to which photographs are reduced on reading, 0 = never; so that 4 GiB of memory "
      "suffice when not given",
      "px", group, &input.MaxSize, 0, MaxExtentPx },
  };
  AppendOptions(table, OptionsOf(input.Silhouette));
  AppendOptions(table, OptionsOf(input.Source, "format"));
  return table;
}
}

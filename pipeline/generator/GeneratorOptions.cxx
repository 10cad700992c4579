// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/GeneratorOptions.h"

#include "core/Error.h"
#include "drawing/SolidTexture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace novelview
{
namespace
{
template <class T>
std::string Text(const T& value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

template <class T>
void CheckRange(const std::string& name, T value, T least, T most)
{
  if (!(value >= least && value <= most)) // also catches what is no number
  {
    throw Error(
      "generate", name + " is out of range", Text(value), Text(least) + " to " + Text(most));
  }
}

void CheckName(
  const std::string& name, const std::string& value, const std::vector<std::string>& known)
{
  if (std::find(known.begin(), known.end(), value) == known.end())
  {
    std::string all;
    for (const std::string& each : known)
    {
      all += (all.empty() ? "" : ", ") + each;
    }
    throw Error("generate", "there is no such " + name, "\"" + value + "\"", all);
  }
}

void CheckViewIds(const std::string& name, const std::vector<int>& viewIds, int views)
{
  for (const int viewId : viewIds)
  {
    CheckRange(name, viewId, 0, views - 1);
  }
}
}

//------------------------------------------------------------------------------
OptionTable OptionsOf(GeneratorOptions& options)
{
  const char* const object = "Object";
  const char* const rig = "Rig";
  const char* const faults = "Imperfections";
  return {
    { "mesh", "built-in object or a ply, obj, stl or vtp file; the Stanford bunny when not given",
      "", object, &options.Mesh },
    { "texture", "solid texture", "", object, &options.Texture, -Unlimited, Unlimited,
      { "wood", "marble", "checker", "plaster", "grey" } },
    { "lit", "mild light fixed to the world instead of colours alone", "", object, &options.Lit },
    { "seed", "moves the texture and draws the noise", "", object, &options.Seed },
    { "views", "photographs", "", rig, &options.Views, 1, 10000 },
    { "step", "angle between neighbouring cameras", "deg", rig, &options.StepDeg, -360, 360 },
    { "elevation", "cameras above the horizon", "deg", rig, &options.ElevationDeg, -90, 90 },
    { "size", "size of the photographs, WIDTHxHEIGHT", "px", rig,
      SizeTarget{ &options.Width, &options.Height }, 16, 16384 },
    { "fieldOfView", "vertical field of view", "deg", rig, &options.FieldOfViewDeg, 1, 150 },
    { "fill", "share of the frame that the object's larger extent takes", "", rig, &options.Fill,
      0.01, 10 },
    { "supersampling", "samples per pixel and axis", "", rig, &options.Supersampling, 1, 16 },
    { "testAngles", "held-out views on the same circle", "deg", rig, &options.TestAnglesDeg },
    { "gainSpread", "brightness of each photograph is off by up to this share", "", faults,
      &options.GainSpread, 0, 1 },
    { "noise", "sigma of the noise of every pixel and channel", "levels", faults,
      &options.NoiseSigma, 0, 255 },
    { "calibrationNoise", "written rotations are off by about this", "px", faults,
      &options.CalibrationNoisePx, 0, 1000 },
    { "maskErode", "masks shrunk by this; negative: grown", "px", faults, &options.MaskErodePx,
      -1000, 1000 },
    { "maskErodeViews", "which masks; all when not given", "", faults, &options.MaskErodeViews, 0,
      Unlimited },
    { "frameShift", "object's centre off the frame's, as a share of its width", "", faults,
      &options.FrameShift, -1, 1 },
    { "frameShiftViews", "in which photographs; every third when not given", "", faults,
      &options.FrameShiftViews, 0, Unlimited },
    { "shadowViews", "photographs in which a shadow lies on the object", "", faults,
      &options.ShadowViews, 0, Unlimited },
    { "shadowDarkness", "share of the light that the shadow takes away", "", faults,
      &options.ShadowDarkness, 0, 1 },
    { "masks", "masks to write", "", faults, &options.Masks, -Unlimited, Unlimited,
      { "exact", "threshold", "none" } },
  };
}

void ValidateGeneratorOptions(const GeneratorOptions& options)
{
  const double most = std::numeric_limits<double>::max();
  CheckName("texture", options.Texture, TextureNames());
  CheckName("kind of masks", options.Masks, { "exact", "threshold", "none" });
  CheckRange("number of views", options.Views, 1, 10000);
  CheckRange("step in degrees", options.StepDeg, -360.0, 360.0);
  // At the pole "up in the picture" would mean nothing.
  CheckRange("elevation in degrees", options.ElevationDeg, -89.0, 89.0);
  CheckRange("width in pixels", options.Width, 8, 32768);
  CheckRange("height in pixels", options.Height, 8, 32768);
  CheckRange("field of view in degrees", options.FieldOfViewDeg, 0.1, 150.0);
  CheckRange("fill of the frame", options.Fill, 0.01, 10.0);
  CheckRange("supersampling", options.Supersampling, 1, 16);
  CheckRange("gain spread", options.GainSpread, 0.0, 1.0);
  CheckRange("noise sigma", options.NoiseSigma, 0.0, 255.0);
  CheckRange("calibration noise in pixels", options.CalibrationNoisePx, 0.0, 100.0);
  CheckRange("mask erosion in pixels", options.MaskErodePx, -1000, 1000);
  CheckRange("frame shift", options.FrameShift, -1.0, 1.0);
  CheckRange("shadow darkness", options.ShadowDarkness, 0.0, 1.0);
  for (const double angleDeg : options.TestAnglesDeg)
  {
    CheckRange("test angle in degrees", angleDeg, -most, most);
  }
  CheckViewIds("view of the mask erosion", options.MaskErodeViews, options.Views);
  CheckViewIds("view of the frame shift", options.FrameShiftViews, options.Views);
  CheckViewIds("view of the shadow", options.ShadowViews, options.Views);
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/GeneratorOptions.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "drawing/SolidTexture.h"

#include <cmath>
#include <string>
#include <vector>

namespace novelview
{
namespace
{
void CheckViewIds(const std::string& name, const std::vector<int>& viewIds, int views)
{
  for (const int viewId : viewIds)
  {
    if (viewId < 0 || viewId >= views)
    {
      throw Error("generate", name + " is out of range", std::to_string(viewId),
        "0 to " + std::to_string(views - 1));
    }
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
      TextureNames() },
    { "lit", "shaded by light instead of colours alone", "", object, &options.Lit },
    { "light",
      "where the light is: mild and fixed to the object, or strong and going with the cameras, as "
      "when the object stands on a turntable",
      "", object, &options.Light, -Unlimited, Unlimited, { "world", "rig" } },
    { "gloss", "strength of highlights; 1 = white", "", object, &options.Gloss, 0, 10 },
    { "exposure", "factor of all brightness; more than white is clipped", "", object,
      &options.Exposure, 0.01, 100 },
    { "seed", "moves the texture and draws the noise", "", object, &options.Seed },
    { "views", "photographs", "", rig, &options.Views, 1, 10000 },
    { "step", "angle between neighbouring cameras", "deg", rig, &options.StepDeg, -360, 360 },
    // At the pole "up in the image" would mean nothing.
    { "elevation", "cameras above the horizon", "deg", rig, &options.ElevationDeg, -89, 89 },
    { "secondRing", "every second camera is so much higher", "deg", rig, &options.SecondRingDeg,
      -178, 178 },
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
      &options.CalibrationNoisePx, 0, 100 },
    { "principalNoise", "written principal points are off by about this", "px", faults,
      &options.PrincipalNoisePx, 0, 100 },
    { "focalNoise", "written focal lengths are off by about this share", "", faults,
      &options.FocalNoise, 0, 0.5 },
    { "defocus", "sigma of a blur", "px", faults, &options.DefocusPx, 0, 50 },
    { "vignetting", "share of the brightness that is missing in the corners", "", faults,
      &options.Vignetting, 0, 1 },
    { "jpeg", "compress as a JPEG of this quality; 0 = not", "", faults, &options.JpegQuality, 0,
      100 },
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
  GeneratorOptions copy = options;
  CheckValues(OptionsOf(copy), "generate");
  if (std::abs(options.ElevationDeg + options.SecondRingDeg) > 89)
  {
    throw Error("generate", "the second ring is out of range",
      Formatted("%g degrees above the horizon", options.ElevationDeg + options.SecondRingDeg),
      "-89 to 89");
  }
  CheckViewIds("view of the mask erosion", options.MaskErodeViews, options.Views);
  CheckViewIds("view of the frame shift", options.FrameShiftViews, options.Views);
  CheckViewIds("view of the shadow", options.ShadowViews, options.Views);
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "Generator.h"

#include "Error.h"
#include "SolidTexture.h"

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

// SPDX-License-Identifier: GPL-3.0-or-later
/** What is plausible of photographs and their calibrations. See ValidateCamera() for the rest. */
#ifndef novelview_CameraLimits_h
#define novelview_CameraLimits_h

#include "base/NumberText.h"
#include "core/Error.h"

#include <string>

namespace novelview
{
/** Of a photograph's width and height, pixels. */
constexpr int MaxExtentPx = 1 << 20;

/** A width or height from a file, where 0 or less means unknown and becomes 0. Throws Error. */
inline int ExtentOf(double value, const std::string& what, const std::string& where)
{
  if (!(value <= MaxExtentPx))
  {
    throw Error(where, what + " is out of range", NumberText(value),
      "at most " + std::to_string(MaxExtentPx));
  }
  return value > 0 ? static_cast<int>(value) : 0;
}
}

#endif

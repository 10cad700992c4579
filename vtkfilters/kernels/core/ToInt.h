// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Conversions of floating-point numbers of unknown size to int. A plain cast of a number that no int
 * holds, or of a NaN, is undefined. These saturate at +-2^30, which is beyond every frame and leaves
 * room to add to the result. For all other numbers the results are those of the plain cast.
 */
#ifndef novelview_ToInt_h
#define novelview_ToInt_h

#include <algorithm>
#include <cmath>

namespace novelview
{
/** `value` in [low, high]. A NaN becomes `low`, unlike with std::clamp(). */
inline double ClampedNumber(double value, double low, double high)
{
  return std::max(low, std::min(value, high));
}

/** Rounds towards zero. A NaN becomes the least result, which lies in no frame. */
inline int ToInt(double value)
{
  constexpr double Limit = 1 << 30;
  return static_cast<int>(ClampedNumber(value, -Limit, Limit));
}

inline int FloorToInt(double value)
{
  return ToInt(std::floor(value));
}

inline int CeilToInt(double value)
{
  return ToInt(std::ceil(value));
}

/** Rounds to nearest, halves away from zero, as std::lround() does. */
inline int RoundToInt(double value)
{
  return ToInt(std::round(value));
}
}

#endif

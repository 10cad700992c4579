// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Parameter_h
#define novelview_Parameter_h

namespace novelview
{
/**
 * Default, range and unit of an option, in one place: the option structs of the kernels, the setters
 * of the filters, the command line and its help all take them from here. A default out of its range
 * does not compile.
 */
template <class T>
struct Parameter
{
  constexpr Parameter(T value, T min, T max, const char* unit = "")
    : Default(value)
    , Min(min)
    , Max(max)
    , Unit(unit)
  {
    if (!(min <= value && value <= max))
    {
      throw "a default is out of its range";
    }
  }

  /** Whether a value lies in the range, ends included; NaN does not. */
  constexpr bool Contains(T value) const { return value >= this->Min && value <= this->Max; }

  T Default;
  T Min;
  T Max;
  const char* Unit; ///< "px", "deg", ..; empty = none
};
}

#endif

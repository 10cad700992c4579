// SPDX-License-Identifier: GPL-3.0-or-later
/** Whether a silhouette can be trusted: how much of the frame it covers. */
#ifndef novelview_Coverage_h
#define novelview_Coverage_h

#include "core/ImageRef.h"

#include <cstdint>
#include <string>
#include <vector>

namespace novelview
{
/** How much of the frame a silhouette covers, and which sides of the frame it touches. */
struct Coverage
{
  double Fraction = 0; ///< 0 to 1, pixels above 127
  bool Left = false;
  bool Right = false;
  bool Top = false;
  bool Bottom = false;

  bool TouchesBorder() const { return this->Left || this->Right || this->Top || this->Bottom; }
};
Coverage MeasureCoverage(const ImageRef<const std::uint8_t>& mask);

/**
 * Throws Error when a silhouette is empty or full; returns a sentence for each thing worth telling
 * (the object leaves the frame, covers almost nothing or almost everything).
 */
std::vector<std::string> CheckCoverage(const Coverage& coverage, const std::string& where);
}

#endif

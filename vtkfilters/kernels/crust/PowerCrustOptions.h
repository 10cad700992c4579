// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of ComputePowerCrust(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_PowerCrustOptions_h
#define novelview_PowerCrustOptions_h

#include "core/Parameter.h"

#include <limits>

namespace novelview
{
/** The surface to make of the samples. */
enum class CrustOutput
{
  PowerCrust,   ///< faces of the power diagram between inside and outside cells
  DelaunayCrust ///< triangles over the samples themselves
};

struct PowerCrustOptions
{
  CrustOutput Output = CrustOutput::DelaunayCrust;

  /**
   * Components and cavities with fewer samples than this are noise and dropped; the largest
   * component stays. 0 keeps everything. DelaunayCrust only.
   */
  static constexpr Parameter<int> MinimumComponentSamplesParameter{ 20, 0,
    std::numeric_limits<int>::max() };
  int MinimumComponentSamples = MinimumComponentSamplesParameter.Default;

  /** Whether samples just below or above the surface are moved onto it. DelaunayCrust only. */
  bool RecoverSamples = true;

  /** Throws Error with the name of the member that is out of range. */
  void Check() const;
};
}

#endif

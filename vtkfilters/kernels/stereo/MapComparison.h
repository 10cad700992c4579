// SPDX-License-Identifier: GPL-3.0-or-later
/** What the depth maps of neighbouring photographs tell about each other, without any truth. */
#ifndef novelview_MapComparison_h
#define novelview_MapComparison_h

#include "core/Execution.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/**
 * Median difference between the depth that a map gives a point and the one that a neighbouring
 * photograph's map gives it, input pixel footprints; 0 when there are too few points in common to
 * tell. Points that the neighbour shows as hidden do not count.
 *
 * @param footprint world size of a pixel at the object.
 */
double DepthNoise(
  const std::vector<View>& views, double footprint, const Execution& execution = {});

/**
 * How much brighter each photograph is than the mean of all (geometric; 1 = as the mean), from the
 * colours that neighbouring photographs give the same surface points: the median of their logarithmic
 * ratios per pair, all pairs balanced by least squares (as in Brown and Lowe 2007). 1 for a
 * photograph that has too few points in common with any other.
 *
 * Views need Color, ContourDistance, DepthMap and Confidence.
 */
std::vector<double> ExposureGains(
  const std::vector<View>& views, double footprint, const Execution& execution = {});

/**
 * Whether the photographs predict each other clearly better when each is divided by its gain. Different
 * exposures say nothing about the next photograph; brightness that changes with the direction, as
 * under lamps that do not turn with the object, is predicted by the neighbours as they are, and gains
 * would take it away. Each photograph is predicted by the blend of those nearest to it, where their
 * maps agree, at the mean exposure.
 *
 * Views need what ExposureGains() needs.
 */
bool GainsPredictBetter(const std::vector<View>& views, const std::vector<double>& gains,
  double footprint, const Execution& execution = {});
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the data sets.
#ifndef novelview_ExifDecision_h
#define novelview_ExifDecision_h

#include "cameras/Photograph.h"

#include <string>
#include <vector>

namespace novelview
{
/**
 * Decides whether the orientation tags of photographs are applied, and sets Orientation. Some
 * calibrations are of the pixels as stored (COLMAP's), others of pictures that a viewer has turned.
 * With "auto" the evidence of each tagged photograph is, in this order: the size in its calibration;
 * the size of its mask; for a quarter turn, the principal point; for a half turn, which way its mask
 * fits the silhouette that the photograph shows. What most of them say is done with all; without any
 * evidence nothing is turned. With "ignore" or "apply" that is done. Notes say what was done, and why.
 */
void DecideExifOrientation(
  const std::string& wanted, std::vector<Photograph>& photographs, std::vector<ReadingNote>& notes);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/** What `convert` does to cameras before it writes them. */
#ifndef novelview_ConvertCameras_h
#define novelview_ConvertCameras_h

#include "base/Console.h"
#include "dataset/Dataset.h"

#include <string>
#include <vector>

namespace novelview
{
/**
 * Replaces rotations to a few digits by the nearest exact ones, and says so: formats with quaternions
 * or projection matrices would turn the rest into other errors.
 */
void MendRotations(
  const DatasetIndex& index, std::vector<Photograph>& photographs, Console& console);

/**
 * Replaces the poses by those with which the photographs agree better, if there are any, and reports
 * the shift of every camera. `photographs` are those of the index without the excluded ones.
 */
void RefinePoses(const DatasetIndex& index, const std::vector<std::string>& exclude,
  std::vector<Photograph>& photographs, Console& console);
}

#endif

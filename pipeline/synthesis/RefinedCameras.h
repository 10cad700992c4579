// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_RefinedCameras_h
#define novelview_RefinedCameras_h

#include "synthesis/Synthesis.h"

#include <vector>

namespace novelview
{
/** The cameras of a data set as preset `best` refines them; see vtkCameraRefiner. */
struct RefinedCameras
{
  bool Accepted = false;        ///< whether the photographs agree clearly better with them
  double ErrorBeforePx = 0;     ///< how far photographs disagree
  double ErrorAfterPx = 0;      ///<
  std::vector<Camera> Cameras;  ///< per view; the given ones unless accepted
  std::vector<double> ShiftsPx; ///< per view, how far the object moves in the picture
};

/** Runs the stages that refine cameras, and no others. Throws Error with the name of the stage. */
RefinedCameras RefineCamerasOf(vtkMultiBlockDataSet* views, const SynthesisListener& listener = {});
}

#endif

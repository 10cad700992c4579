// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_GeneratorRig_h
#define novelview_GeneratorRig_h

#include "generator/GeneratorOptions.h"
#include "geometry/Camera.h"

#include <vtkPolyData.h>

#include <vector>

namespace novelview
{
/** The cameras of a rig. */
struct Rig
{
  std::vector<Camera> Views;   ///< true cameras, aimed off the object by FrameShift
  std::vector<Camera> Written; ///< what the calibration file states: Views with CalibrationNoisePx
  std::vector<Camera> Tests;
};

/**
 * The rig for an object; the distance is such that the object takes the requested share of the
 * frame.
 */
Rig MakeRig(vtkPolyData* mesh, const GeneratorOptions& options);
}

#endif

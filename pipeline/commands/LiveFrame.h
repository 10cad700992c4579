// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_LiveFrame_h
#define novelview_LiveFrame_h

#include "cameras/CameraGrid.h"
#include "live/FrameQueue.h"
#include "synthesis/Synthesis.h"

#include <cstdint>
#include <vector>

namespace novelview
{
/**
 * One picture of the page of `view`: the novel view, its depth (nearer is brighter) or its mesh, as
 * PNG, with the surface point to pick. What is wrong with it is an answer; only Interrupted is thrown.
 */
FrameAnswer MakeLiveFrame(
  Synthesis& synthesis, const CameraGrid& grid, const FrameRequest& request);

/** Small pictures of all photographs, as JPEG files. */
std::vector<std::vector<std::uint8_t>> ThumbnailsOf(vtkMultiBlockDataSet* views);
}

#endif

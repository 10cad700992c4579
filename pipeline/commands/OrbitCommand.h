// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_OrbitCommand_h
#define novelview_OrbitCommand_h

#include "base/Console.h"
#include "commands/OrbitOptions.h"
#include "processes/ProcessGroup.h"

namespace novelview
{
/**
 * `novelview orbit`: the video of a moving camera (CamerasOfFrames). Hull, crust and depth
 * maps are made once; frames are shared out between the processes.
 *
 *     options.Out        a video, or a folder of images as below
 *     options.FramesDir  frame_NNNN.png, mask/frame_NNNN.png and, written last, frames_par.txt with
 *                        their cameras; also when options.Out is a folder
 *
 * Throws UsageError, Error, naming the frame, and Interrupted when the console requests a stop.
 */
void RenderOrbit(const OrbitOptions& options, Console& console, ProcessGroup& processes);
}

#endif

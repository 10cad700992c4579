// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_EvaluateCommand_h
#define novelview_EvaluateCommand_h

#include "base/Console.h"
#include "commands/EvaluateOptions.h"
#include "processes/ProcessGroup.h"

namespace novelview
{
/**
 * `novelview evaluate`: views that no stage has seen are predicted and compared with their
 * photographs. Hull, crust and depth maps are made once per set of references; views are shared out
 * between the processes. options.Out gets
 *
 *     scores.csv       view,stage,rms,psnr,ssim,iou,missing,excess
 *     scores.json      protocol, scores, means, gap closure, options, versions
 *     chart.png        RMS and SSIM of the stages over the views
 *     NAME.STAGE.png   the predictions, and overview.png, a contact sheet; with options.Pictures
 *
 * Scores are written last, so a folder with scores.json is complete. Throws Error, naming the view,
 * and Interrupted when the console requests a stop.
 */
void EvaluateDataset(const EvaluateOptions& options, Console& console, ProcessGroup& processes);
}

#endif

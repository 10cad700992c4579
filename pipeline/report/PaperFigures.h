// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PaperFigures_h
#define novelview_PaperFigures_h

#include "report/RunPage.h"

namespace novelview
{
/**
 * The section "In the form of the paper" (Chia, He and Lin 2013): the stages as in figures 12 and 14,
 * the RMS after every iteration as in tables 1 to 4, and the novel view with the mesh, seen from
 * beside, at the start, after iterations 1, 2, 5, 10 and the last of both deformers, and of the truth.
 */
void AddPaperFigures(ReportPage& page, const RunPageInput& input);
}

#endif

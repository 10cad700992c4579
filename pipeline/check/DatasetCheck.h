// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * The checks of a data set: its contents, its problems, and how to correct them.
 */
#ifndef novelview_DatasetCheck_h
#define novelview_DatasetCheck_h

#include "check/CheckReport.h"
#include "core/Execution.h"
#include "dataset/DatasetInput.h"

namespace novelview
{
/**
 * Examines a data set. Throws Error only where there is nothing to examine: no folder, no calibration
 * that can be read, no photograph left; and Interrupted.
 */
CheckReport CheckDataset(const DatasetInput& input, const Execution& execution = {});
}

#endif

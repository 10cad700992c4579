// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ReferenceDepthOptions_h
#define novelview_ReferenceDepthOptions_h

#include "fusion/TsdfField.h"
#include "stereo/PlaneSweepCost.h"
#include "stereo/ReferenceDepthParameters.h"
#include "stereo/SemiGlobal.h"

namespace novelview
{
struct ReferenceDepthOptions
{
  /** Photographs each is matched with, the nearest in angle. */
  int Neighbours = ReferenceDepthParameters::Neighbours.Default;
  double MaxAngleDeg = 65;     ///< and no further than this
  double CoarseFirstPx = -1.5; ///< first pass: offsets behind the hull's front, pixel footprints
  double CoarseLastPx = ReferenceDepthParameters::CoarseLastPx.Default;
  double CoarseStepPx = 4;
  int FusedViews = 16;     ///< maps fused as one photograph sees them: its own and the nearest
  double FineRangePx = 24; ///< second pass: offsets about the fused surface, each way
  double FineStepPx = 2;
  double AgreementPx = 4; ///< depths of two photographs agree within this
  int AgreementViews = 6; ///< looked at for agreement, the nearest in angle
  MatchOptions Match;
  SemiGlobalOptions SemiGlobal;
  FusionOptions Fusion;
};
}

#endif

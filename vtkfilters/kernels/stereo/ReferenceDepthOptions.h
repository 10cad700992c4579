// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of EstimateReferenceDepths() and its steps. Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_ReferenceDepthOptions_h
#define novelview_ReferenceDepthOptions_h

#include "core/Parameter.h"
#include "fusion/FusionOptions.h"

namespace novelview
{
/** Of the matching cost. */
struct MatchOptions
{
  static constexpr Parameter<int> WindowRadiusParameter{ 2, 1, 5, "px" };
  int WindowRadius = WindowRadiusParameter.Default;
  int BestNeighbours = 2; ///< the cost is the mean over the best so many
  /** Of the truncated colour difference; the rest is correlation. */
  static constexpr Parameter<double> ColorShareParameter{ 0.5, 0, 1 };
  double ColorShare = ColorShareParameter.Default;
  double ColorTruncation = 40; ///< grey levels
  double Noise = 12;           ///< variance added to the correlation's denominators
};

/** Of AggregateSemiGlobally(). */
struct SemiGlobalOptions
{
  double P1 = 0.03; ///< P1, between labels that differ by one
  double P2 = 0.2;  ///< P2, between any others
};

/** Of EstimateReferenceDepths(). */
struct ReferenceDepthOptions
{
  /** Photographs each is matched with, the nearest in angle. */
  static constexpr Parameter<int> NeighboursParameter{ 4, 1, 16 };
  int Neighbours = NeighboursParameter.Default;
  double MaxAngleDeg = 65;     ///< and no further than this
  double CoarseFirstPx = -1.5; ///< first pass: offsets behind the hull's front, pixel footprints
  static constexpr Parameter<double> CoarseLastPxParameter{ 150, 4, 1000, "pixel footprints" };
  double CoarseLastPx = CoarseLastPxParameter.Default;
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

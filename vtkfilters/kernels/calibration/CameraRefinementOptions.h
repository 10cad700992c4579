// SPDX-License-Identifier: GPL-3.0-or-later
/** Options of RefineCameras(). Without Eigen, since a header of a VTK class includes it. */
#ifndef novelview_CameraRefinementOptions_h
#define novelview_CameraRefinementOptions_h

#include "core/Parameter.h"

namespace novelview
{
/** Of FindPointTracks(). */
struct PointTrackOptions
{
  int CellPx = 12;        ///< at most one point in each square of this size
  int WindowRadius = 5;   ///< of the windows compared, pixels
  int SearchPx = 5;       ///< how far off the projection is searched, each way, in both directions
  int Neighbours = 4;     ///< source images of each reference image
  double MinCosine = 0.4; ///< of the incidence, in both images
  double MinSimilarity = 0.8; ///< zero-mean normalised cross-correlation
  double MinContrast = 4;     ///< square root of the smaller eigenvalue of the structure tensor,
                              ///< grey levels per pixel
};

struct CameraRefinementOptions
{
  PointTrackOptions Tracks;
  double LossPx = 0.5;          ///< scale of the robust loss of a reprojection error
  double FirstDeviationPx = 1;  ///< how far a given camera may be off, assumed at first,
  double MinDeviationPx = 0.02; ///< and at least
  double DeviationLoss = 4;     ///< scale of its robust loss, in deviations
  int MaxIterations = 50;
  int HoldOut = 5;    ///< one track in so many takes no part and judges the result
  int MinJudges = 50; ///< with fewer of them the given cameras are kept
  /** Refined cameras are accepted when the judges' error falls by this share of it at least. */
  static constexpr Parameter<double> MinGainParameter{ 0.05, 0, 1 };
  double MinGain = MinGainParameter.Default;
};
}

#endif

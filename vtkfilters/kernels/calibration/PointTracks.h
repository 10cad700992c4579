// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PointTracks_h
#define novelview_PointTracks_h

#include "calibration/CameraRefinementOptions.h"
#include "core/Execution.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/** Where a view shows a point. */
struct PointObservation
{
  int View;
  Eigen::Vector2d Pixel;
};

/** A surface point and where photographs show it; the first observation is the reference image's. */
struct PointTrack
{
  Eigen::Vector3d Position;
  std::vector<PointObservation> Observations;
};

/**
 * Points of the surface that several photographs show, each where the photograph itself shows it
 * and not where its camera says: in every view the corners of the texture, placed by the depth map
 * and searched in the neighbouring views around their projection in two dimensions. The window is
 * warped by the tangent plane of the depth map; the offset is refined to a fraction of a pixel by a
 * parabola through the correlations.
 *
 * Views need Color, Mask, DepthMap and Confidence.
 */
std::vector<PointTrack> FindPointTracks(const std::vector<View>& views,
  const PointTrackOptions& options = {}, const Execution& execution = {});
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CameraRefinement_h
#define novelview_CameraRefinement_h

#include "calibration/PointTracks.h"
#include "core/Execution.h"
#include "geometry/View.h"

#include <vector>

namespace novelview
{
/** The cameras, and what was found out about them. */
struct CameraRefinement
{
  std::vector<Camera> Cameras; ///< the refined ones if accepted, else those given, bit for bit
  std::vector<double>
    ShiftsPx; ///< per camera: RMS move of the object in its image; 0 if not accepted
  /**
   * Distance from the epipolar line: median over the pairs of observations that a camera takes part
   * in, mean over the cameras, of tracks that took no part.
   */
  double ErrorBeforePx = 0;
  double ErrorAfterPx = 0; ///< the same with the refined cameras
  bool Accepted = false;
};

/**
 * Bundle adjustment of the cameras' poses over point tracks (Triggs, McLauchlan, Hartley and
 * Fitzgibbon 2000): the least of
 *
 *     sum over observations of rho(|project(camera, X) - pixel|^2)
 *   + sum over cameras of rho((f^2 |w|^2 + |f d / z|^2) / sigma^2)
 *
 * over all points X and, for each camera, a rotation w about its centre and a displacement d; rho is
 * Cauchy's loss, so that one camera may be off by more than the others, f the focal length, z the object's depth. The second sum keeps the given world:
 * the photographs say nothing about its position, orientation and scale, and little about moves that
 * change every photograph alike.
 *
 * sigma is how far the given cameras are off, estimated from the data: the first adjustment assumes
 * FirstDeviationPx; with the median distances e from the epipolar lines of tracks that took no
 * part, sigma^2 = e_before^2 - e_after^2 for the second. Exact cameras thereby stay nearly as they are,
 * and unless those tracks' error falls by MinGain, they stay as they are bit for bit.
 *
 * Views need Color, Mask, DepthMap and Confidence. Results do not depend on the number of threads.
 */
CameraRefinement RefineCameras(const std::vector<View>& views,
  const CameraRefinementOptions& options = {}, const Execution& execution = {});
}

#endif

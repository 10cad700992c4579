// SPDX-License-Identifier: GPL-3.0-or-later
/** How well the silhouettes of some views agree. */
#ifndef novelview_AgreementSurvey_h
#define novelview_AgreementSurvey_h

#include "core/Execution.h"
#include "geometry/View.h"
#include "silhouettes/SilhouetteRays.h"

#include <vector>

namespace novelview
{
/** How well a set of views agrees; lists are by view. */
struct AgreementSurvey
{
  /**
   * Intersection over union of the silhouette and the visual hull of all views, projected (which
   * lies inside of it): the part of its pixels whose rays meet the hull within a pixel.
   */
  std::vector<double> Iou;
  double MeanIou = 0;
  /**
   * Part of the other views' contour rays that would meet the hull without this view, among those
   * whose rays do not.
   */
  std::vector<double> ExclusivelyCarved;
  /** The mean of Iou over the others if this view were left out. */
  std::vector<double> MeanIouWithout;
  /** The best mean with at most one view left out. */
  double RobustIou = 0;
  /** Points on the hull. */
  std::vector<Eigen::Vector3d> Points;
};

/** `rays` is the number per view of each kind (area and contour). */
AgreementSurvey SurveyAgreement(
  const std::vector<View>& views, int rays, const Execution& execution = {});

/** Rays of all views, `count` each: AreaRays or ContourRays. */
std::vector<SilhouetteRay> AllRays(const std::vector<View>& views, int count,
  std::vector<SilhouetteRay> (*raysOfView)(const std::vector<View>&, int, int));

/** 0 when there are none. */
double MeanOf(const std::vector<double>& values);
}

#endif

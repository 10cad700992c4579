// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the fused field.
#ifndef novelview_TsdfView_h
#define novelview_TsdfView_h

#include "core/ImageRef.h"
#include "geometry/Camera.h"

#include <Eigen/Core>

#include <algorithm>

namespace novelview
{
/** Where a view sees a point. */
struct ProjectedSample
{
  double X, Y;     ///< pixels
  double Depth;    ///< of the point
  int Column, Row; ///< the nearest pixel
};

/** What a view knows. */
struct TsdfView
{
  Eigen::Matrix<double, 3, 4> P;
  ImageRef<const float> ContourDistance;
  ImageRef<const float> DepthMap;
  ImageRef<const float> Confidence;
  const Camera* Cam;

  /** Adds what the view's map says about the point. */
  void Accumulate(
    const ProjectedSample& sample, double tau, double grazing, double& f, double& w) const
  {
    const double depth = this->DepthMap(sample.Column, sample.Row);
    const double s = depth - sample.Depth;
    if (depth > 0 && s >= -tau)
    {
      double confidence = this->Confidence(sample.Column, sample.Row);
      if (grazing > 0)
      {
        const double unsure = 1 - confidence;
        confidence *=
          1 - grazing * unsure * unsure * unsure * (1 - this->Incidence(sample.Column, sample.Row));
      }
      f += confidence * std::min(1.0, s / tau);
      w += confidence;
    }
  }

  /**
   * Adds the same with a vote that fades from the surface to tau behind it, so that the two sides
   * of a thin part do not outvote each other. F is that times `unit`.
   */
  void AccumulateTapered(
    const ProjectedSample& sample, double tau, double unit, double& f, double& w) const
  {
    const double depth = this->DepthMap(sample.Column, sample.Row);
    const double s = (depth - sample.Depth) / tau;
    if (depth > 0 && s > -1)
    {
      const double weight = this->Confidence(sample.Column, sample.Row) * std::min(1.0, 1 + s);
      f += unit * weight * std::min(1.0, s);
      w += weight;
    }
  }

  /** How many steps from a point its picture stays within `pixels` of here, and in the frame. */
  int StepsWithin(double pixels, const ProjectedSample& sample, const Eigen::Vector3d& step) const;

  /** Cosine of the angle at which the view sees the surface of its map at a pixel. */
  double Incidence(int x, int y) const;
};
}

#endif

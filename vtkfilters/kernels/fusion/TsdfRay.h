// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the fused field.
#ifndef novelview_TsdfRay_h
#define novelview_TsdfRay_h

#include "fusion/TsdfView.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace novelview
{
/** A ray through the field, and where the views see one of its points. */
class TsdfRay
{
public:
  TsdfRay(const std::vector<TsdfView>& views, const Eigen::Vector3d& origin,
    const Eigen::Vector3d& direction);

  /** Projects its point at parameter t into all views. */
  void MoveTo(double t);

  /** Where view i sees the point; false when it is behind the camera or outside the frame. */
  bool See(int i, const TsdfView& view, ProjectedSample& sample) const
  {
    sample.Column = this->Pixels[i];
    sample.Row = this->Pixels[this->Count + i];
    sample.X = this->Numbers[6 * this->Count + i];
    sample.Y = this->Numbers[7 * this->Count + i];
    sample.Depth = this->Numbers[8 * this->Count + i];
    return view.ContourDistance.Contains(sample.Column, sample.Row);
  }

private:
  double* Array(int i)
  {
    return this->Numbers.data() + static_cast<std::ptrdiff_t>(i) * this->Count;
  }

  int Count;
  std::vector<double> Numbers;
  std::vector<int> Pixels;
};
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
// Private to HullConsistency. In a header, since most of the time goes into it.
#ifndef novelview_SilhouetteWitness_h
#define novelview_SilhouetteWitness_h

#include "core/ImageRef.h"
#include "geometry/Camera.h"
#include "geometry/View.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace novelview
{
/** A range of the parameter of a ray. */
struct RayRange
{
  double From = 0;
  double To = 1;

  /** Keeps the part where a linear function with these values at 0 and 1 is not negative. */
  void Clip(double at0, double at1)
  {
    if (at0 < 0 && at1 < 0)
    {
      this->To = this->From - 1;
    }
    else if (at0 < 0)
    {
      this->From = std::max(this->From, at0 / (at0 - at1));
    }
    else if (at1 < 0)
    {
      this->To = std::min(this->To, at0 / (at0 - at1));
    }
  }
  bool Empty() const { return !(this->From < this->To); }
};

/** A ray in a view's image: h(q) = (1 - q) Start + q End, pixel h.head / h.z, q in [0, 1]. */
struct PictureLine
{
  Eigen::Vector3d Start;
  Eigen::Vector3d End;

  Eigen::Vector3d At(double q) const { return (1 - q) * this->Start + q * this->End; }
};

/** A silhouette with queries for points. */
class SilhouetteWitness
{
public:
  explicit SilhouetteWitness(const View& view)
    : Cam(view.Cam)
    , Distance(view.ContourDistance)
  {
    const ImageRef<const std::uint8_t>& mask = view.Mask;
    for (int x = 0; x < mask.Width; ++x)
    {
      this->Top |= view.IsObject(x, 0);
      this->Bottom |= view.IsObject(x, mask.Height - 1);
    }
    for (int y = 0; y < mask.Height; ++y)
    {
      this->Left |= view.IsObject(0, y);
      this->Right |= view.IsObject(mask.Width - 1, y);
    }
  }

  /** The ray from `origin` (q = 0) along `direction` to infinity (q = 1). */
  PictureLine Line(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const
  {
    return { this->Cam.K * this->Cam.ToCamera(origin), this->Cam.K * (this->Cam.R * direction) };
  }

  /**
   * Where a line lies in front of the camera and, as far as one range tells it, no more than `px`
   * beyond a closed side: the corners next to an open side are open, too (see Ask).
   */
  RayRange Range(const PictureLine& line, double px) const
  {
    const double right = this->Distance.Width - 1 + px;
    const double bottom = this->Distance.Height - 1 + px;
    RayRange range;
    const auto clip = [&](double sign, int axis, double limit)
    {
      range.Clip(sign * (line.Start[axis] - limit * line.Start.z()),
        sign * (line.End[axis] - limit * line.End.z()));
    };
    range.Clip(line.Start.z(), line.End.z());
    const bool columnsBound = !this->Top && !this->Bottom;
    const bool rowsBound = !this->Left && !this->Right;
    if (!this->Left && columnsBound)
    {
      clip(1, 0, -px);
    }
    if (!this->Right && columnsBound)
    {
      clip(-1, 0, right);
    }
    if (!this->Top && rowsBound)
    {
      clip(1, 1, -px);
    }
    if (!this->Bottom && rowsBound)
    {
      clip(-1, 1, bottom);
    }
    return range;
  }

  /**
   * The signed distance inside the contour at a point of a line; adds 1 to `seen` in the frame.
   * Infinity beyond an open side: an object that leaves the frame to the right may rise there
   * above the frame's upper side, which it does not reach inside the frame.
   */
  double Ask(const Eigen::Vector3d& h, double floorPx, int& seen) const
  {
    if (!(h.z() > 0))
    {
      return -floorPx;
    }
    const double x = h.x() / h.z();
    const double y = h.y() / h.z();
    const double right = this->Distance.Width - 1;
    const double bottom = this->Distance.Height - 1;
    if ((this->Left && x < -0.5) || (this->Top && y < -0.5) || (this->Right && x > right + 0.5) ||
      (this->Bottom && y > bottom + 0.5))
    {
      return std::numeric_limits<double>::infinity();
    }
    const double beyond = std::max({ this->Left ? 0 : -x, this->Right ? 0 : x - right,
      this->Top ? 0 : -y, this->Bottom ? 0 : y - bottom, 0.0 });
    if (beyond > 0)
    {
      const double there = SampleBilinear(this->Distance, x, y);
      return std::max(std::min(there, 0.0) - beyond, -floorPx);
    }
    ++seen;
    return std::max(SampleBilinear(this->Distance, x, y), -floorPx);
  }

  const Camera& Cam;

private:
  ImageRef<const float> Distance;
  bool Left = false; ///< whether the silhouette reaches this side of the frame
  bool Right = false;
  bool Top = false;
  bool Bottom = false;
};
}

#endif

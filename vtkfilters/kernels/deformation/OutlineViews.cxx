// SPDX-License-Identifier: GPL-3.0-or-later
#include "deformation/OutlineViews.h"

#include "geometry/DepthImage.h"
#include "geometry/ViewSelection.h"
#include "stereo/PhotoConsistency.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace novelview
{
using Eigen::Vector3d;

std::vector<int> ContourViews(
  const std::vector<View>& views, const Camera& novel, const OutlineOptions& options)
{
  const double minCosine = std::cos(options.NearAngleDeg * EIGEN_PI / 180);
  std::vector<int> near;
  for (const int viewId : ViewsByAngle(views, novel.OpticalAxis()))
  {
    if (static_cast<int>(near.size()) < options.NearViews &&
      views[viewId].Cam.OpticalAxis().dot(novel.OpticalAxis()) >= minCosine)
    {
      near.push_back(viewId);
    }
  }
  return near;
}

OutlineViewSelector::OutlineViewSelector(const TriangleMesh& mesh, const std::vector<View>& views,
  const Camera& novel, const OutlineOptions& options, const Execution& execution)
  : Views(views)
  , Options(options)
  , Order(ViewsByAngle(views, novel.OpticalAxis()))
  , Neighbours(NearestNeighbours(views, static_cast<int>(views.size()) - 1))
  , Depths(views.size())
{
  execution.ForEach(static_cast<std::int64_t>(views.size()),
    [&](std::int64_t viewId) { this->Depths[viewId] = RasteriseDepth(mesh, views[viewId].Cam); });
}

OutlineViews OutlineViewSelector::Select(const Vector3d& point, const Vector3d& step) const
{
  OutlineViews selected;
  const auto key = std::find_if(this->Order.begin(), this->Order.end(),
    [&](int viewId) { return this->Tells(viewId, point, step); });
  if (key == this->Order.end())
  {
    return selected;
  }
  const double minCosine = std::cos(this->Options.MaxApartDeg * EIGEN_PI / 180);
  const Vector3d axis = this->Views[*key].Cam.OpticalAxis();
  for (const int viewId : this->Neighbours[*key])
  {
    if (this->Views[viewId].Cam.OpticalAxis().dot(axis) > minCosine &&
      static_cast<int>(selected.Secondaries.size()) < this->Options.Secondaries &&
      this->Tells(viewId, point, step))
    {
      selected.Secondaries.push_back(viewId);
    }
  }
  selected.Key = selected.Secondaries.empty() || this->IsFlat(*key, point, step) ? -1 : *key;
  return selected;
}

/** Whether a camera lies on the moving side of a point and sees it. */
bool OutlineViewSelector::Tells(int viewId, const Vector3d& point, const Vector3d& step) const
{
  const Camera& camera = this->Views[viewId].Cam;
  const Vector3d towards = (camera.Centre() - point).normalized();
  return step.normalized().dot(towards) >= this->Options.MinFacing && camera.Depth(point) > 0 &&
    camera.InFrame(camera.Project(point)) &&
    IsUnoccluded(this->Depths[viewId].Ref(), camera, point, this->Options.BehindPx);
}

/** Whether the photograph is flat where it shows what lies behind the point. */
bool OutlineViewSelector::IsFlat(int key, const Vector3d& point, const Vector3d& step) const
{
  const Vector3d inside = point - this->Options.WindowRadius * step;
  const View& view = this->Views[key];
  return view.Cam.Depth(inside) <= 0 ||
    WindowMatcher(view, view.Cam.Project(inside), this->Options.WindowRadius).Variance() <
    this->Options.MinVariance;
}
}

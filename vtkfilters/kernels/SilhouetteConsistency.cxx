// SPDX-License-Identifier: GPL-3.0-or-later
#include "SilhouetteConsistency.h"

#include "Error.h"
#include "SearchBox.h"
#include "ViewSelection.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double None = std::numeric_limits<double>::infinity();

/** What stands against a ray's touching the object. */
struct Blame
{
  int View;
  double Excess; ///< pixels by which that view's silhouette would have to reach further
};

/** Follows rays through the silhouettes, each larger by its offset. */
class RayFollower
{
public:
  RayFollower(const std::vector<View>& views, const std::vector<double>& offsets,
    const Eigen::AlignedBox3d& box)
    : Views(views)
    , Offsets(offsets)
    , Centre(box.center())
    , Reach(0.5 * box.diagonal().norm())
    , Step(2 * MedianFootprint(views, box.center()))
  {
  }

  /** Where a pixel's ray lies deepest inside the silhouettes of the other views. */
  std::optional<Blame> Follow(int viewId, const Vector2d& pixel) const
  {
    const Camera& camera = this->Views[viewId].Cam;
    const Vector3d origin = camera.Centre();
    const Vector3d direction = camera.Unproject(pixel, 1) - origin;
    const double middle = camera.Depth(this->Centre);
    Blame best{ -1, -None };
    for (double t = std::max(middle - this->Reach, this->Step); t <= middle + this->Reach;
         t += this->Step)
    {
      const Blame least = this->LeastInside(viewId, origin + t * direction);
      if (least.View >= 0 && least.Excess > best.Excess)
      {
        best = least;
      }
    }
    return best.View >= 0 ? std::optional(best) : std::nullopt;
  }

private:
  /** The least distance inside the contours of all views but one; and whose it is. */
  Blame LeastInside(int except, const Vector3d& x) const
  {
    Blame least{ -1, None };
    for (int k = 0; k < static_cast<int>(this->Views.size()); ++k)
    {
      const Camera& camera = this->Views[k].Cam;
      if (k == except || camera.Depth(x) <= 0)
      {
        continue;
      }
      const Vector2d u = camera.Project(x);
      const ImageRef<const float>& contour = this->Views[k].ContourDistance;
      if (contour.Contains(
            static_cast<int>(std::floor(u.x() + 0.5)), static_cast<int>(std::floor(u.y() + 0.5))))
      {
        const double inside = SampleBilinear(contour, u.x(), u.y()) + this->Offsets[k];
        if (inside < least.Excess)
        {
          least = { k, inside };
        }
      }
    }
    return least;
  }

  const std::vector<View>& Views;
  const std::vector<double>& Offsets;
  const Vector3d Centre;
  const double Reach;
  const double Step;
};

/** The pixels just inside a silhouette's contour, thinned out evenly. */
std::vector<Vector2d> EdgePixels(const View& view, int about)
{
  std::vector<Vector2d> pixels;
  for (int y = 0; y < view.ContourDistance.Height; ++y)
  {
    for (int x = 0; x < view.ContourDistance.Width; ++x)
    {
      if (view.ContourDistance(x, y) >= 0.5f && view.ContourDistance(x, y) < 1.5f)
      {
        pixels.emplace_back(x, y);
      }
    }
  }
  const std::size_t every = std::max<std::size_t>(1, pixels.size() / about);
  std::vector<Vector2d> thinned;
  for (std::size_t i = 0; i < pixels.size(); i += every)
  {
    thinned.push_back(pixels[i]);
  }
  return thinned;
}

struct Survey
{
  std::size_t Rays = 0;
  std::vector<Blame> Blames; ///< of the rays that something stands against
};

std::vector<Survey> SurveyAll(const std::vector<View>& views, const std::vector<double>& offsets,
  const Eigen::AlignedBox3d& box, const ConsistencyOptions& options, const Execution& execution)
{
  const RayFollower follower(views, offsets, box);
  std::vector<Survey> surveys(views.size());
  execution.ForEach(static_cast<std::int64_t>(views.size()),
    [&](std::int64_t j)
    {
      const View& view = views[j];
      for (const Vector2d& pixel : EdgePixels(view, options.RaysPerView))
      {
        ++surveys[j].Rays;
        const auto blame = follower.Follow(static_cast<int>(j), pixel);
        // The pixel itself lies this far inside its own contour.
        const double own =
          view.ContourDistance(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
        if (blame && own - blame->Excess > options.LeastPx)
        {
          surveys[j].Blames.push_back({ blame->View, own - blame->Excess });
        }
      }
    });
  return surveys;
}

double Median(std::vector<double> values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> Judge(const std::vector<Survey>& surveys, const ConsistencyOptions& options)
{
  std::vector<std::vector<double>> excesses(surveys.size());
  std::vector<double> shares(surveys.size(), 0);
  std::size_t rays = 0;
  for (const Survey& survey : surveys)
  {
    rays += survey.Rays;
    for (const Blame& blame : survey.Blames)
    {
      excesses[blame.View].push_back(blame.Excess);
    }
  }
  for (std::size_t k = 0; k < surveys.size(); ++k)
  {
    const std::size_t others = rays - surveys[k].Rays;
    shares[k] = others ? static_cast<double>(excesses[k].size()) / others : 0;
  }
  const double usual = Median(shares);
  std::vector<double> offsets(surveys.size(), 0);
  for (std::size_t k = 0; k < surveys.size(); ++k)
  {
    if (shares[k] > options.LeastShare && shares[k] > options.Outstanding * usual)
    {
      std::vector<double>& e = excesses[k];
      std::sort(e.begin(), e.end());
      offsets[k] = e[(e.size() - 1) * 9 / 10];
    }
  }
  return offsets;
}
}

std::vector<double> FindContourOffsets(
  const std::vector<View>& views, const ConsistencyOptions& options, const Execution& execution)
{
  Eigen::AlignedBox3d box;
  try
  {
    box = FindSearchBox(views);
  }
  catch (const Error&)
  {
    return std::vector<double>(views.size(), 0);
  }
  std::vector<double> offsets(views.size(), 0);
  // A small offset may show only once a large one no longer hides it.
  for (int round = 0; round < options.Rounds; ++round)
  {
    const std::vector<double> more =
      Judge(SurveyAll(views, offsets, box, options, execution), options);
    if (*std::max_element(more.begin(), more.end()) <= 0)
    {
      break;
    }
    std::transform(more.begin(), more.end(), offsets.begin(), offsets.begin(), std::plus<>());
  }
  return offsets;
}
}

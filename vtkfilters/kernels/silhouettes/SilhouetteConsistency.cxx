// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SilhouetteConsistency.h"

#include "core/Error.h"
#include "core/Quantile.h"
#include "core/ToInt.h"
#include "geometry/ViewSelection.h"
#include "silhouettes/SearchBox.h"
#include "silhouettes/SilhouetteField.h"

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
    , Contours(views.begin(), views.end())
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
    const double start = std::max(middle - this->Reach, this->Step);
    const int count = ToInt((middle + this->Reach - start) / this->Step) + 1;
    Blame best{ -1, -None };
    int asked = 0; // the view that spoke against the last point may well speak against the next
    // A look every now and then first: the better the best, the more can be skipped.
    for (const int stride : { CoarseStride, 1 })
    {
      for (int i = 0; i < count;)
      {
        const Vector3d x = origin + (start + i * this->Step) * direction;
        const double hopeless = this->Probe(viewId, x, asked, best);
        const int skipped = ToInt(hopeless / (this->Step * direction.norm()));
        i += std::max(stride, std::min(skipped, count));
      }
    }
    return best.View >= 0 ? std::optional(best) : std::nullopt;
  }

private:
  static constexpr int CoarseStride = 16;

  /**
   * Takes the least distance inside the contours of all views but one, and whose it is, for `best`
   * if it is more. Otherwise returns the radius around x within which no point is better either.
   */
  double Probe(int except, const Vector3d& x, int& asked, Blame& best) const
  {
    Blame least{ -1, None };
    const int count = static_cast<int>(this->Contours.size());
    for (int i = 0; i < count; ++i)
    {
      const int k = (asked + i) % count;
      const ContourView& contour = this->Contours[k];
      const ContourView::Pixel pixel = contour.Project(x);
      if (k == except || pixel.Depth <= 0 || pixel.Inside < 0)
      {
        continue;
      }
      const double inside = contour.DistanceAt(pixel) + this->Offsets[k];
      if (inside <= best.Excess)
      {
        asked = k;
        return contour.RadiusFor(std::min(best.Excess - inside, pixel.Inside), pixel.Depth);
      }
      if (inside < least.Excess)
      {
        least = { k, inside };
      }
    }
    best = least.View >= 0 ? least : best;
    return 0;
  }

  const std::vector<View>& Views;
  const std::vector<ContourView> Contours;
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

/** What the rays through one silhouette's edge met. */
struct Survey
{
  std::vector<Blame> Blames; ///< the excess is below 0 where nothing stands against the ray
};

std::vector<Survey> SurveyAll(const std::vector<View>& views, const std::vector<double>& offsets,
  const Eigen::AlignedBox3d& box, const ConsistencyOptions& options, const Execution& execution)
{
  const RayFollower follower(views, offsets, box);
  const int rays =
    std::clamp(options.RaysOfAll / static_cast<int>(views.size()), 1, options.RaysPerView);
  std::vector<Survey> surveys(views.size());
  execution.ForEach(static_cast<std::int64_t>(views.size()),
    [&](std::int64_t j)
    {
      const View& view = views[j];
      for (const Vector2d& pixel : EdgePixels(view, rays))
      {
        if (const auto blame = follower.Follow(static_cast<int>(j), pixel))
        {
          // The pixel itself lies this far inside its own contour.
          const double own =
            view.ContourDistance(static_cast<int>(pixel.x()), static_cast<int>(pixel.y()));
          surveys[j].Blames.push_back({ blame->View, own - blame->Excess });
        }
      }
    });
  return surveys;
}

/** By how much each silhouette that stands out is too small. */
std::vector<double> FindOutstanding(
  const std::vector<Survey>& surveys, const ConsistencyOptions& options)
{
  std::vector<std::vector<double>> excesses(surveys.size());
  std::size_t rays = 0;
  for (const Survey& survey : surveys)
  {
    rays += survey.Blames.size();
    for (const Blame& blame : survey.Blames)
    {
      if (blame.Excess > options.MinPx)
      {
        excesses[blame.View].push_back(blame.Excess);
      }
    }
  }
  std::vector<double> shares(surveys.size(), 0);
  for (std::size_t k = 0; k < surveys.size(); ++k)
  {
    const std::size_t others = rays - surveys[k].Blames.size();
    shares[k] = others ? static_cast<double>(excesses[k].size()) / static_cast<double>(others) : 0;
  }
  // A ray that gives way to the culprit may run into another: the worst are put right first.
  const double least = std::max({ options.MinShare, options.Outstanding * Quantile(shares, 0.5),
    0.6 * *std::max_element(shares.begin(), shares.end()) });
  std::vector<double> offsets(surveys.size(), 0);
  for (std::size_t k = 0; k < surveys.size(); ++k)
  {
    if (shares[k] > least)
    {
      offsets[k] = Quantile(excesses[k], 0.9);
    }
  }
  return offsets;
}

/** How much all silhouettes together are too small: of those that are off to either side, the
 * smaller one decides everywhere. */
double FindSlack(const std::vector<Survey>& surveys, const ConsistencyOptions& options)
{
  std::vector<double> disagreements;
  for (const Survey& survey : surveys)
  {
    std::vector<double> excesses;
    for (const Blame& blame : survey.Blames)
    {
      excesses.push_back(blame.Excess);
    }
    disagreements.push_back(Quantile(excesses, 0.9));
  }
  const double usual = Quantile(disagreements, 0.5);
  return usual > options.MinPx ? std::min(0.5 * usual, options.MaxSlackPx) : 0;
}
}

std::vector<double> FindContourOffsets(
  const std::vector<View>& views, const ConsistencyOptions& options, const Execution& execution)
{
  std::vector<double> offsets(views.size(), 0);
  Eigen::AlignedBox3d box;
  try
  {
    box = FindSearchBox(views);
  }
  catch (const Error&)
  {
    return offsets;
  }
  std::vector<Survey> surveys;
  // A small offset may show only once a large one no longer hides it.
  for (int round = 0; round < options.Rounds; ++round)
  {
    surveys = SurveyAll(views, offsets, box, options, execution);
    const std::vector<double> more = FindOutstanding(surveys, options);
    if (*std::max_element(more.begin(), more.end()) <= 0)
    {
      break;
    }
    std::transform(more.begin(), more.end(), offsets.begin(), offsets.begin(), std::plus<>());
  }
  const double slack = FindSlack(surveys, options);
  for (double& offset : offsets)
  {
    offset += slack;
  }
  return offsets;
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "silhouettes/SilhouetteRepair.h"

#include "core/ConnectedRegions.h"
#include "core/Quantile.h"
#include "core/ToInt.h"
#include "geometry/DepthImage.h"
#include "geometry/ViewSelection.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;
using Bits = Image<std::uint8_t>;

/** Pixels whose square neighbourhood of this radius holds a set pixel. */
Bits Dilated(const Bits& image, int radius)
{
  Bits result(image.Width, image.Height);
  for (int y = 0; y < image.Height; ++y)
  {
    for (int x = 0; x < image.Width; ++x)
    {
      if (!image(x, y))
      {
        continue;
      }
      for (int j = std::max(y - radius, 0); j <= std::min(y + radius, image.Height - 1); ++j)
      {
        std::fill(&result(std::max(x - radius, 0), j),
          &result(std::min(x + radius, image.Width - 1), j) + 1, std::uint8_t(255));
      }
    }
  }
  return result;
}

/** Drops connected regions (4 neighbours) that wanted(region) refuses; returns whether any is left. */
template <class Wanted>
bool KeepRegions(Bits& image, const Wanted& wanted)
{
  bool any = false;
  ForEachRegion(
    image.Width, image.Height, [&](int x, int y) { return image(x, y) > 0; },
    [&](const PixelRegion& region)
    {
      const bool keeps = wanted(region);
      any = any || keeps;
      for (const auto& [x, y] : region)
      {
        image(x, y) = keeps ? 255 : 0;
      }
    });
  return any;
}

/** Median and mean deviation of the colours of some pixels. */
struct ColourModel
{
  explicit ColourModel(std::array<std::vector<double>, 3> values)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      std::vector<double>& some = values[channel];
      this->Median[channel] = Quantile(some, 0.5);
      for (double& value : some)
      {
        value = std::abs(value - this->Median[channel]);
      }
      this->Deviation[channel] = Quantile(std::move(some), 0.5) + 3; // grey levels of noise
    }
  }

  double Distance(const std::uint8_t* rgb) const
  {
    double sum = 0;
    for (int channel = 0; channel < 3; ++channel)
    {
      const double d = (rgb[channel] - this->Median[channel]) / this->Deviation[channel];
      sum += d * d;
    }
    return sum;
  }

  std::array<double, 3> Median;
  std::array<double, 3> Deviation;
};

/** The colours of what lies more than `margin` pixels inside a silhouette, or outside (sign -1). */
ColourModel ColoursOf(const View& view, float sign, float margin)
{
  std::array<std::vector<double>, 3> values;
  for (int y = 0; y < view.Cam.Height; y += 2)
  {
    for (int x = 0; x < view.Cam.Width; x += 2)
    {
      if (sign * view.ContourDistance(x, y) > margin)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          values[channel].push_back(view.Color(x, y, channel));
        }
      }
    }
  }
  return ColourModel(std::move(values));
}

class PartFinder
{
public:
  PartFinder(const std::vector<View>& views, const TriangleMesh& hull,
    const SilhouetteRepairOptions& options, const Execution& execution)
    : Views(views)
    , Options(options)
    , Run(execution)
    , Footprint(MedianFootprint(views, hull.Points))
    , Uncovered(views.size())
  {
    for (const Vector3d& point : hull.Points)
    {
      this->Box.extend(point);
    }
    const Vector3d margin = options.MarginShare * this->Box.sizes();
    this->Box = { this->Box.min() - margin, this->Box.max() + margin };
    this->Run.ForEach(static_cast<std::int64_t>(views.size()),
      [&](std::int64_t i) { this->Uncovered[i] = this->UncoveredOf(views[i], hull); });
  }

  MissingParts Find() const
  {
    const std::size_t count = this->Views.size();
    // What the rays of each view ask for, before all is put together: every ray has its own.
    std::vector<MissingParts> ofView(count, MissingParts(count));
    this->Run.ForEach(
      static_cast<std::int64_t>(count), [&](std::int64_t i) { this->FollowRays(i, ofView[i]); });
    MissingParts parts(count);
    for (const MissingParts& some : ofView)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        Merge(some[i], parts[i]);
      }
    }
    for (Bits& part : parts)
    {
      if (!part.Values.empty() && !this->KeepLarge(part, this->Options.MinAreaPx / 2))
      {
        part = {};
      }
    }
    return parts;
  }

private:
  static bool KeepLarge(Bits& image, int minArea)
  {
    return KeepRegions(image,
      [minArea](const PixelRegion& region) { return static_cast<int>(region.size()) >= minArea; });
  }

  /**
   * The larger parts of a silhouette that the hull does not cover and whose colours are those of the
   * object: a silhouette that has grown over the background is no witness. Empty when there are none.
   */
  Bits UncoveredOf(const View& view, const TriangleMesh& hull) const
  {
    const Image<float> depth = RasteriseDepth(hull, view.Cam);
    Bits covered(depth.Width, depth.Height);
    for (std::size_t i = 0; i < covered.Values.size(); ++i)
    {
      covered.Values[i] = std::isfinite(depth.Values[i]) ? 255 : 0;
    }
    covered = Dilated(covered, this->Options.SlackPx);
    Bits uncovered(depth.Width, depth.Height);
    for (int y = 0; y < depth.Height; ++y)
    {
      for (int x = 0; x < depth.Width; ++x)
      {
        uncovered(x, y) = view.ContourDistance(x, y) > 0 && !covered(x, y) ? 255 : 0;
      }
    }
    if (!this->KeepLarge(uncovered, this->Options.MinAreaPx))
    {
      return {};
    }
    const ColourModel object = ColoursOf(view, 1, 3);
    const ColourModel background = ColoursOf(view, -1, 3);
    const auto looksLikeObject = [&](const PixelRegion& region)
    {
      const auto like = std::count_if(region.begin(), region.end(),
        [&](const std::pair<int, int>& at)
        {
          const std::uint8_t* rgb = view.Color.Pixel(at.first, at.second);
          return object.Distance(rgb) < background.Distance(rgb);
        });
      return 2 * like > static_cast<std::ptrdiff_t>(region.size());
    };
    return KeepRegions(uncovered, looksLikeObject) ? uncovered : Bits();
  }

  /** Walks the rays of a view's uncovered pixels and notes the missing parts on them. */
  void FollowRays(std::size_t viewId, MissingParts& parts) const
  {
    const Bits& uncovered = this->Uncovered[viewId];
    for (int y = 0; y < uncovered.Height; ++y)
    {
      this->Run.CheckCancelled();
      for (int x = 0; x < uncovered.Width; ++x)
      {
        if (uncovered(x, y))
        {
          this->FollowRay(this->Views[viewId].Cam, Vector2d(x, y), parts);
        }
      }
    }
  }

  /** The silhouettes outside which a point lies, and where. */
  using Dissenters = std::vector<std::pair<std::size_t, Vector2d>>;

  /** Of the points of the ray that may be missing, those that the fewest silhouettes lack. */
  void FollowRay(const Camera& camera, const Vector2d& pixel, MissingParts& parts) const
  {
    const Vector3d centre = camera.Centre();
    const Vector3d direction = camera.RayDirection(pixel);
    const double middle = (this->Box.center() - centre).dot(direction);
    const double reach = this->Box.diagonal().norm() / 2;
    std::size_t fewest = this->Options.MaxDissenters + std::size_t(1);
    std::vector<Dissenters> missing;
    for (double t = std::max(middle - reach, this->Footprint); t < middle + reach;
         t += this->Footprint)
    {
      const Vector3d point = centre + t * direction;
      Dissenters dissenters;
      if (this->Box.contains(point) && this->MayBeMissing(point, dissenters))
      {
        fewest = std::min(fewest, dissenters.size());
        missing.push_back(std::move(dissenters));
      }
    }
    for (const Dissenters& dissenters : missing)
    {
      for (const auto& [viewId, at] : dissenters)
      {
        if (dissenters.size() == fewest)
        {
          this->Note(viewId, at, parts[viewId]);
        }
      }
    }
  }

  /** Whether the silhouettes that lack a point are clearly outvoted. */
  bool MayBeMissing(const Vector3d& point, Dissenters& dissenters) const
  {
    int witnesses = 0;
    for (std::size_t i = 0; i < this->Views.size(); ++i)
    {
      const View& view = this->Views[i];
      if (view.Cam.Depth(point) <= 0)
      {
        continue;
      }
      const Vector2d pixel = view.Cam.Project(point);
      if (!view.Cam.InFrame(pixel))
      {
        continue;
      }
      const int x = FloorToInt(pixel.x() + 0.5);
      const int y = FloorToInt(pixel.y() + 0.5);
      witnesses += !this->Uncovered[i].Values.empty() && this->Uncovered[i](x, y);
      if (view.ContourDistance(x, y) <= 0)
      {
        dissenters.emplace_back(i, pixel);
        if (static_cast<int>(dissenters.size()) > this->Options.MaxDissenters)
        {
          return false;
        }
      }
    }
    return !dissenters.empty() && witnesses >= this->Options.MinWitnesses &&
      witnesses >= static_cast<int>(dissenters.size()) + this->Options.MinMajority;
  }

  void Note(std::size_t viewId, const Vector2d& pixel, Bits& part) const
  {
    const Camera& camera = this->Views[viewId].Cam;
    if (part.Values.empty())
    {
      part = Bits(camera.Width, camera.Height);
    }
    const int x = FloorToInt(pixel.x());
    const int y = FloorToInt(pixel.y());
    for (const auto& [i, j] : { std::pair(x, y), { x + 1, y }, { x, y + 1 }, { x + 1, y + 1 } })
    {
      if (part.Ref().Contains(i, j) && this->Views[viewId].ContourDistance(i, j) <= 0)
      {
        part(i, j) = 255;
      }
    }
  }

  static void Merge(const Bits& from, Bits& to)
  {
    if (to.Values.empty())
    {
      to = from;
      return;
    }
    for (std::size_t i = 0; i < from.Values.size(); ++i)
    {
      to.Values[i] |= from.Values[i];
    }
  }

  const std::vector<View>& Views;
  const SilhouetteRepairOptions& Options;
  const Execution& Run;
  const double Footprint;
  Eigen::AlignedBox3d Box;
  std::vector<Bits> Uncovered;
};
}

MissingParts FindMissingParts(const std::vector<View>& views, const TriangleMesh& hull,
  const SilhouetteRepairOptions& options, const Execution& execution)
{
  if (hull.Points.empty())
  {
    return MissingParts(views.size());
  }
  return PartFinder(views, hull, options, execution).Find();
}
}

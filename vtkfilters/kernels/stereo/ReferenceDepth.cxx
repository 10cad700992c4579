// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/ReferenceDepth.h"

#include "core/FillHolesIteratively.h"
#include "core/ToInt.h"
#include "fusion/TsdfField.h"
#include "geometry/DepthImage.h"
#include "geometry/ViewSelection.h"
#include "stereo/DepthConfidence.h"
#include "stereo/MaskedMedian.h"
#include "stereo/NeighbourMatching.h"
#include "stereo/SemiGlobal.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

/** Depth of the hull's front in a photograph, and how far behind it its back is. */
struct HullInterval
{
  Image<float> Front; ///< 0 = none
  Image<float> Thickness;
};

HullInterval IntervalOf(const TriangleMesh& hull, const MatchImage& image)
{
  DepthRange range = RasteriseRange(hull, image.Cam);
  HullInterval interval{ std::move(range.Nearest), std::move(range.Farthest) };
  for (std::size_t i = 0; i < interval.Front.Values.size(); ++i)
  {
    float& front = interval.Front.Values[i];
    float& thickness = interval.Thickness.Values[i];
    const bool takes = std::isfinite(front) && image.Pixels.Values[4 * i + 3] > 0;
    thickness = takes ? thickness - front : 0.f;
    front = takes ? front : 0.f;
  }
  return interval;
}

/** Depth and photo score of one photograph from one pass. */
struct PassResult
{
  Image<float> Depth;
  Image<float> Score;
};

/** Whether a pixel shows no more than "too bright" or "too dark". */
bool IsClipped(const std::uint8_t* rgbl)
{
  const auto [least, most] = std::minmax({ rgbl[0], rgbl[1], rgbl[2] });
  return least >= 250 || most <= 5;
}

/** The share of the object's pixels in the window about a pixel of the object that are not clipped. */
float UnclippedShare(const MatchImage& image, int x, int y, int radius)
{
  int count = 0;
  int clipped = 0;
  for (int j = std::max(y - radius, 0); j <= std::min(y + radius, image.Pixels.Height - 1); ++j)
  {
    for (int i = std::max(x - radius, 0); i <= std::min(x + radius, image.Pixels.Width - 1); ++i)
    {
      const std::uint8_t* pixel = &image.Pixels(i, j);
      count += pixel[3] > 0;
      clipped += pixel[3] > 0 && IsClipped(pixel);
    }
  }
  return 1 - (count ? static_cast<float>(clipped) / static_cast<float>(count) : 0.f);
}

PassResult MatchPass(const MatchImage& reference, const Image<float>& base,
  const Image<float>& last, const std::vector<const MatchImage*>& neighbours,
  const DepthHypotheses& labels, const ReferenceDepthOptions& options, const Execution& execution)
{
  PassResult result;
  result.Depth = Image<float>(base.Width, base.Height);
  result.Score = Image<float>(base.Width, base.Height);
  const PixelBox box = BoxOfBase(base);
  if (box.Empty() || neighbours.empty())
  {
    return result;
  }
  const CostVolume volume =
    MatchNeighbours(reference, base, last, neighbours, box, labels, options.Match, execution);
  const CostVolume sums = AggregateSemiGlobally(volume, base, options.SemiGlobal, execution);
  Image<std::uint8_t> winner;
  result.Depth = MaskedMedian(WinnerTakesAll(sums, base, winner), 2);
  for (int y = 0; y < box.Height(); ++y)
  {
    for (int x = 0; x < box.Width(); ++x)
    {
      const int frameX = box.XBegin + x;
      const int frameY = box.YBegin + y;
      if (base(frameX, frameY) > 0)
      {
        const float cost = volume.Row(y, winner(frameX, frameY))[x];
        result.Score(frameX, frameY) =
          UnclippedShare(reference, frameX, frameY, options.Match.WindowRadius) *
          (1 - cost / CostVolume::Unit);
      }
    }
  }
  return result;
}

/** Enlarges twice; smooth where the four neighbours agree within `jump`, else the nearest. */
Image<float> Enlarged(const Image<float>& half, int width, int height, float jump)
{
  Image<float> full(width, height);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const int nearX = std::min(x / 2, half.Width - 1);
      const int nearY = std::min(y / 2, half.Height - 1);
      const float nearest = half(nearX, nearY);
      const int otherX = std::clamp(nearX + (x % 2 ? 1 : -1), 0, half.Width - 1);
      const int otherY = std::clamp(nearY + (y % 2 ? 1 : -1), 0, half.Height - 1);
      const float values[3] = { half(otherX, nearY), half(nearX, otherY), half(otherX, otherY) };
      const bool agree = std::all_of(values, values + 3,
        [&](float value) { return value > 0 && std::abs(value - nearest) < jump; });
      full(x, y) = agree && nearest > 0
        ? 0.5625f * nearest + 0.1875f * (values[0] + values[1]) + 0.0625f * values[2]
        : nearest;
    }
  }
  return full;
}

/** Gives object pixels without a value that of a neighbour, until every one has one. */
void FillKnown(Image<float>& image, const MatchImage& mask)
{
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < image.Values.size(); ++i)
  {
    if (image.Values[i] <= 0 && mask.Pixels.Values[4 * i + 3] > 0)
    {
      open.push_back(i);
    }
  }
  // What is new in a layer stays negative until the layer is done.
  FillHolesIteratively(
    std::move(open),
    [&image](std::size_t i)
    {
      const int x = static_cast<int>(i % image.Width);
      const int y = static_cast<int>(i / image.Width);
      float value = 0;
      for (const auto& [dx, dy] : { std::pair(-1, 0), { 1, 0 }, { 0, -1 }, { 0, 1 } })
      {
        if (image.Ref().Contains(x + dx, y + dy) && value <= 0)
        {
          value = image(x + dx, y + dy);
        }
      }
      image.Values[i] = value > 0 ? -value : image.Values[i];
      return value > 0;
    },
    [&image](std::size_t i) { image.Values[i] = -image.Values[i]; });
}

class Estimator
{
public:
  Estimator(const std::vector<View>& views, const TriangleMesh& hull,
    const ReferenceDepthOptions& options, const Execution& execution)
    : Views(views)
    , Hull(hull)
    , Options(options)
    , Run(execution)
    , Count(static_cast<std::int64_t>(views.size()))
    , Footprint(MedianFootprint(views, hull.Points))
    , Neighbours(NearestNeighbours(views, options.Neighbours))
    , Depths(views.size())
    , Confidences(views.size())
  {
    const double minCosine = std::cos(options.MaxAngleDeg * EIGEN_PI / 180);
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      std::erase_if(this->Neighbours[i],
        [&](int j)
        { return views[i].Cam.OpticalAxis().dot(views[j].Cam.OpticalAxis()) < minCosine; });
    }
  }

  std::vector<ReferenceDepth> Estimate()
  {
    std::vector<ReferenceDepth> result(this->Views.size());
    if (this->Footprint <= 0)
    {
      for (std::size_t i = 0; i < result.size(); ++i)
      {
        const Camera& camera = this->Views[i].Cam;
        result[i].Depth = result[i].Confidence = Image<float>(camera.Width, camera.Height);
      }
      return result;
    }
    std::vector<Image<float>> bases = this->FusedBases();
    // The first pass is in the bases now; at full size its maps weigh as much as the photographs.
    this->Depths = std::vector<Image<float>>(result.size());
    this->Confidences = std::vector<Image<float>>(result.size());
    const std::vector<MatchImage> images = this->Reduced(1);
    this->InBatches(
      0.4, 0.95, [&](std::int64_t i) { this->FinePass(i, images, std::exchange(bases[i], {})); });
    this->Rate();
    for (std::size_t i = 0; i < result.size(); ++i)
    {
      result[i] = { std::move(this->Depths[i]), std::move(this->Confidences[i]) };
    }
    this->Run.Report(1);
    return result;
  }

private:
  /** All views, a few at a time, so that progress and interruption get their turn. */
  template <class Body>
  void InBatches(double begin, double end, const Body& body)
  {
    constexpr std::int64_t batch = 4;
    for (std::int64_t first = 0; first < this->Count; first += batch)
    {
      const std::int64_t size = std::min(batch, this->Count - first);
      this->Run.ForEach(size, [&](std::int64_t i) { body(first + i); });
      this->Run.Report(begin + (end - begin) * static_cast<double>(first + size) / this->Count);
    }
  }

  std::vector<MatchImage> Reduced(int reduction) const
  {
    std::vector<MatchImage> images(this->Views.size());
    this->Run.ForEach(
      this->Count, [&](std::int64_t i) { images[i] = MakeMatchImage(this->Views[i], reduction); });
    return images;
  }

  std::vector<const MatchImage*> NeighbourImages(
    std::int64_t i, const std::vector<MatchImage>& images) const
  {
    std::vector<const MatchImage*> result;
    for (const int j : this->Neighbours[i])
    {
      result.push_back(&images[j]);
    }
    return result;
  }

  /** The first pass: the fused surface as each photograph sees it, at half resolution. */
  std::vector<Image<float>> FusedBases()
  {
    const std::vector<MatchImage> images = this->Reduced(2);
    std::vector<HullInterval> intervals(images.size());
    this->InBatches(0.0, 0.25,
      [&](std::int64_t i)
      {
        intervals[i] = IntervalOf(this->Hull, images[i]);
        this->CoarsePass(i, images, intervals[i]);
      });
    this->EnlargeMaps();
    this->Rate();
    std::vector<View> views = this->Views;
    for (std::size_t i = 0; i < views.size(); ++i)
    {
      views[i].DepthMap = this->Depths[i].Ref();
      views[i].Confidence = this->Confidences[i].Ref();
    }
    const TsdfField field(views, this->Options.Fusion, this->Footprint);
    std::vector<std::vector<int>> around = NearestNeighbours(views, this->Options.FusedViews - 1);
    std::vector<Image<float>> bases(images.size());
    this->InBatches(0.25, 0.4,
      [&](std::int64_t i)
      {
        around[i].push_back(static_cast<int>(i));
        std::sort(around[i].begin(), around[i].end());
        bases[i] = this->SeenFrom(images[i], intervals[i], field.Of(around[i]));
      });
    return bases;
  }

  void CoarsePass(
    std::int64_t i, const std::vector<MatchImage>& images, const HullInterval& interval)
  {
    const float thickest =
      *std::max_element(interval.Thickness.Values.begin(), interval.Thickness.Values.end());
    DepthHypotheses labels;
    labels.First = this->Options.CoarseFirstPx * this->Footprint;
    labels.Step = this->Options.CoarseStepPx * this->Footprint;
    const double last = std::min<double>(thickest, this->Options.CoarseLastPx * this->Footprint);
    labels.Count = std::clamp(ToInt((last - labels.First) / labels.Step) + 1, 1, 255);
    this->Keep(i,
      MatchPass(images[i], interval.Front, interval.Thickness, this->NeighbourImages(i, images),
        labels, this->Options, this->Run));
  }

  /** To full size: rated and fused at half of it, thin parts are lost. */
  void EnlargeMaps()
  {
    const float jump = static_cast<float>(3 * this->Footprint);
    this->Run.ForEach(this->Count,
      [&](std::int64_t i)
      {
        const Camera& camera = this->Views[i].Cam;
        this->Depths[i] = Enlarged(this->Depths[i], camera.Width, camera.Height, jump);
        this->Confidences[i] = Enlarged(this->Confidences[i], camera.Width, camera.Height, 0.f);
      });
  }

  Image<float> SeenFrom(
    const MatchImage& image, const HullInterval& interval, const TsdfField& field) const
  {
    Image<float> base(image.Cam.Width, image.Cam.Height);
    const Vector3d centre = image.Cam.Centre();
    for (int y = 0; y < base.Height; ++y)
    {
      this->Run.CheckCancelled();
      for (int x = 0; x < base.Width; ++x)
      {
        const double front = interval.Front(x, y);
        if (front <= 0)
        {
          continue;
        }
        // With a direction of unit depth the ray's parameter is the depth itself.
        const Vector3d direction = image.Cam.Unproject(Vector2d(x, y), 1) - centre;
        const auto met = field.FindFirstCrossing(centre, direction, front - 1.5 * this->Footprint,
          front + interval.Thickness(x, y), this->Options.CoarseStepPx * this->Footprint);
        base(x, y) = static_cast<float>(met.Surface.value_or(0));
      }
    }
    FillKnown(base, image);
    return MaskedMedian(base, 2);
  }

  void FinePass(std::int64_t i, const std::vector<MatchImage>& images, const Image<float>& halfBase)
  {
    const MatchImage& image = images[i];
    Image<float> base = Enlarged(
      halfBase, image.Cam.Width, image.Cam.Height, static_cast<float>(6 * this->Footprint));
    FillKnown(base, image);
    for (std::size_t n = 0; n < base.Values.size(); ++n)
    {
      base.Values[n] = image.Pixels.Values[4 * n + 3] > 0 ? base.Values[n] : 0.f;
    }
    DepthHypotheses labels;
    labels.First = -this->Options.FineRangePx * this->Footprint;
    labels.Step = this->Options.FineStepPx * this->Footprint;
    labels.Count = 2 * ToInt(this->Options.FineRangePx / this->Options.FineStepPx) + 1;
    const Image<float> last(base.Width, base.Height, 1, static_cast<float>(1e30));
    this->Keep(i,
      MatchPass(
        image, base, last, this->NeighbourImages(i, images), labels, this->Options, this->Run));
  }

  /** The photo score stands in the place of the confidence until all depths are known. */
  void Keep(std::int64_t i, PassResult&& pass)
  {
    this->Depths[i] = std::move(pass.Depth);
    this->Confidences[i] = std::move(pass.Score);
  }

  void Rate()
  {
    this->Run.ForEach(this->Count,
      [&](std::int64_t i)
      {
        this->Confidences[i] = DepthConfidence(this->Views, static_cast<int>(i), this->Depths,
          this->Confidences[i], this->Options, this->Footprint, this->Run);
      });
  }

  const std::vector<View>& Views;
  const TriangleMesh& Hull;
  const ReferenceDepthOptions& Options;
  const Execution& Run;
  const std::int64_t Count;
  const double Footprint;
  std::vector<std::vector<int>> Neighbours;
  std::vector<Image<float>> Depths;
  std::vector<Image<float>> Confidences;
};
}

std::vector<ReferenceDepth> EstimateReferenceDepths(const std::vector<View>& views,
  const TriangleMesh& hull, const ReferenceDepthOptions& options, const Execution& execution)
{
  return Estimator(views, hull, options, execution).Estimate();
}
}

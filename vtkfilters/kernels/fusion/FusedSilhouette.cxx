// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion/FusedSilhouette.h"

#include "core/ConnectedRegions.h"
#include "core/ToInt.h"
#include "fusion/RayMarcher.h"
#include "geometry/Rasteriser.h"
#include "geometry/Visibility.h"
#include "silhouettes/ContourDistance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int Band = 3;        ///< pixels either side of the first contour that are looked at
constexpr double Margin = 1.5; ///< rays begin so many footprints before the mesh
constexpr double NearPx = 1.6; ///< the prediction matters so near the contour

/** Calls body(x, y) for every pixel, rows in parallel. */
template <class Body>
void ForEachPixel(const Image<float>& image, const Execution& execution, const Body& body)
{
  execution.ForEach(image.Height,
    [&](std::int64_t y)
    {
      for (int x = 0; x < image.Width; ++x)
      {
        body(x, static_cast<int>(y));
      }
    });
}

/** Finds the signed distance of every pixel's ray from the object, in novel pixels, above 0 = it
 * misses. Far from the contour only the sign counts. */
class DistanceTracer
{
public:
  DistanceTracer(const TriangleMesh& mesh, const std::vector<View>& views, const TsdfField& field,
    const Camera& novel, double footprint, const FusedSilhouetteOptions& options,
    const Execution& execution)
    : Views(views)
    , Novel(novel)
    , Footprint(footprint)
    , Options(options)
    , Run(execution)
    , Front(Rasterise(mesh, novel, execution).Depth)
    , Marcher(field, novel, BoundingDiagonal(mesh.Points), options.StepPx * footprint)
    , Inside(novel.Width, novel.Height)
    , Distance(novel.Width, novel.Height, 1, static_cast<float>(Band))
    , Depth(novel.Width, novel.Height)
  {
  }

  /**
   * First the pixels like the black fields of a chessboard, and of the white ones those whose
   * neighbours do not agree. What lies on white fields alone, which touch at their corners only, is
   * not found; it would be no region of a size that stays either (RemoveSmallRegions).
   */
  void TraceCentres()
  {
    for (const bool white : { false, true })
    {
      ForEachPixel(this->Distance, this->Run,
        [&](int x, int y)
        {
          if ((x + y) % 2 == white)
          {
            const std::optional<bool> known =
              white ? this->AgreementAround(x, y) : std::optional<bool>();
            this->Inside(x, y) = known ? *known : this->Meets(x, y);
            this->Distance(x, y) = static_cast<float>(this->Inside(x, y) ? -Band : Band);
          }
        });
    }
  }

  void TraceBand()
  {
    ForEachPixel(this->Distance, this->Run,
      [&](int x, int y)
      {
        // The mesh's front near the pixel: just outside the mesh's rim the centre misses it.
        const double front = this->NearestFront(x, y);
        if (std::isfinite(front) && this->NearContour(x, y))
        {
          const auto approach =
            this->Marcher.FindClosestApproach(Vector2d(x, y), front - Margin * this->Footprint);
          this->Distance(x, y) = static_cast<float>(
            approach.SignedDistance * this->Footprint / this->Novel.PixelFootprint(approach.At));
          this->Depth(x, y) = static_cast<float>(approach.At);
        }
      });
  }

  void DrawToPrediction()
  {
    const Image<float> traced = this->Distance;
    ForEachPixel(traced, this->Run,
      [&](int x, int y)
      {
        const bool framed =
          x >= 2 && y >= 2 && x < this->Novel.Width - 2 && y < this->Novel.Height - 2;
        if (framed && this->Depth(x, y) > 0 && std::abs(traced(x, y)) < NearPx)
        {
          this->Distance(x, y) = static_cast<float>(this->Drawn(traced, x, y));
        }
      });
  }

  void DrawToSupport()
  {
    for (const SupportPoint& point : this->Options.Support)
    {
      if (this->Novel.Depth(point.Position) > 0)
      {
        const double inside =
          this->Options.SupportShare * std::min(point.InsidePx, this->Options.SupportMaxPx);
        this->Cover(this->Novel.Project(point.Position), inside);
      }
    }
  }

  Image<float> Take() { return std::move(this->Distance); }

private:
  /** Whether the ray of a pixel's centre meets the object. */
  bool Meets(int x, int y) const
  {
    const double front = this->Front(x, y);
    return std::isfinite(front) &&
      this->Marcher.FindFirstCrossing(Vector2d(x, y), front - Margin * this->Footprint).Min < 0;
  }

  /** Whether all four neighbours are inside, or all outside; nothing when some are. */
  std::optional<bool> AgreementAround(int x, int y) const
  {
    int count = 0;
    int inside = 0;
    for (const auto& [dx, dy] : { std::pair(-1, 0), { 1, 0 }, { 0, -1 }, { 0, 1 } })
    {
      if (this->Inside.Ref().Contains(x + dx, y + dy))
      {
        ++count;
        inside += this->Inside(x + dx, y + dy);
      }
    }
    return inside == 0 || inside == count ? std::optional<bool>(inside > 0) : std::nullopt;
  }

  /** Makes the object reach `inside` pixels beyond a pixel, as far as the mesh does. */
  void Cover(const Vector2d& pixel, double inside)
  {
    const int x = RoundToInt(pixel.x());
    const int y = RoundToInt(pixel.y());
    for (int j = y - 1; j <= y + 1; ++j)
    {
      for (int i = x - 1; i <= x + 1; ++i)
      {
        if (this->Distance.Ref().Contains(i, j) && std::isfinite(this->Front(i, j)))
        {
          const double distance = (Vector2d(i, j) - pixel).norm() - inside;
          this->Distance(i, j) = std::min(this->Distance(i, j), static_cast<float>(distance));
        }
      }
    }
  }

  double NearestFront(int x, int y) const
  {
    float front = std::numeric_limits<float>::infinity();
    for (int j = std::max(y - 2, 0); j <= std::min(y + 2, this->Novel.Height - 1); ++j)
    {
      for (int i = std::max(x - 2, 0); i <= std::min(x + 2, this->Novel.Width - 1); ++i)
      {
        front = std::min(front, this->Front(i, j));
      }
    }
    return front;
  }

  bool NearContour(int x, int y) const
  {
    for (int j = std::max(y - Band, 0); j <= std::min(y + Band, this->Novel.Height - 1); ++j)
    {
      for (int i = std::max(x - Band, 0); i <= std::min(x + Band, this->Novel.Width - 1); ++i)
      {
        if (this->Inside(i, j) != this->Inside(x, y))
        {
          return true;
        }
      }
    }
    return false;
  }

  double Drawn(const Image<float>& traced, int x, int y) const
  {
    const double own = traced(x, y);
    Vector2d outwards(0, 0);
    for (int j = -2; j <= 2; ++j)
    {
      for (int i = -2; i <= 2; ++i)
      {
        outwards += std::clamp<double>(traced(x + i, y + j), -2, 2) * Vector2d(i, j);
      }
    }
    if (outwards.norm() < 1e-6)
    {
      return own;
    }
    const double depth = this->Depth(x, y);
    const Vector3d point = this->Novel.Unproject(Vector2d(x, y), depth);
    const Vector3d ray = (point - this->Novel.Centre()).normalized();
    Vector3d normal = this->Novel.Unproject(Vector2d(x, y) + outwards.normalized(), depth) - point;
    normal -= normal.dot(ray) * ray;
    const double perPixel = normal.norm();
    const auto predicted =
      PredictContour(this->Views, point, ray, normal / perPixel, this->Options.Prediction);
    if (!predicted)
    {
      return own;
    }
    const double distance = predicted->Distance / perPixel;
    const double apart = (distance - own) / this->Options.PredictionGatePx;
    const double misfit =
      predicted->Residual / this->Footprint / this->Options.PredictionResidualPx;
    const double weight =
      this->Options.PredictionWeight * std::exp(-apart * apart - misfit * misfit);
    return (own + weight * distance) / (1 + weight);
  }

  const std::vector<View>& Views;
  const Camera& Novel;
  const double Footprint;
  const FusedSilhouetteOptions& Options;
  const Execution& Run;
  const Image<float> Front;
  const RayMarcher Marcher;
  Image<std::uint8_t> Inside;
  Image<float> Distance;
  Image<float> Depth; ///< where a ray of the band comes nearest; 0 elsewhere
};

/** Convolves rows, or columns, with a normalised kernel; the border is repeated. */
Image<float> Convolved(const Image<float>& image, const std::vector<float>& kernel, bool rows,
  const Execution& execution)
{
  Image<float> result(image.Width, image.Height);
  const int radius = static_cast<int>(kernel.size() / 2);
  ForEachPixel(image, execution,
    [&](int x, int y)
    {
      float sum = 0;
      for (int k = -radius; k <= radius; ++k)
      {
        sum += kernel[k + radius] *
          (rows ? image(std::clamp(x + k, 0, image.Width - 1), y)
                : image(x, std::clamp(y + k, 0, image.Height - 1)));
      }
      result(x, y) = sum;
    });
  return result;
}

Image<float> Smoothed(const Image<float>& image, double sigma, const Execution& execution)
{
  // Below this a Gaussian on a pixel grid does nothing.
  if (sigma < 0.3)
  {
    return image;
  }
  const int radius = CeilToInt(3 * sigma);
  std::vector<float> kernel;
  float sum = 0;
  for (int k = -radius; k <= radius; ++k)
  {
    kernel.push_back(static_cast<float>(std::exp(-0.5 * k * k / (sigma * sigma))));
    sum += kernel.back();
  }
  for (float& value : kernel)
  {
    value /= sum;
  }
  return Convolved(Convolved(image, kernel, true, execution), kernel, false, execution);
}

/** Turns connected regions (4 neighbours) on one side of 127.5 that are too small to the other. */
void RemoveSmallRegions(Image<std::uint8_t>& image, bool object, double minArea)
{
  ForEachRegion(
    image.Width, image.Height, [&](int x, int y) { return (image(x, y) > 127) == object; },
    [&](const PixelRegion& region)
    {
      if (static_cast<double>(region.size()) < minArea)
      {
        for (const auto& [x, y] : region)
        {
          image(x, y) = object ? 0 : 255;
        }
      }
    });
}
}

Image<float> FusedSilhouette(const TriangleMesh& mesh, const std::vector<View>& views,
  const TsdfField& field, const Camera& novel, double footprint,
  const FusedSilhouetteOptions& options, const Execution& execution)
{
  DistanceTracer tracer(mesh, views, field, novel, footprint, options, execution);
  tracer.TraceCentres();
  execution.Report(0.2);
  tracer.TraceBand();
  execution.Report(0.35);
  if (options.UsePrediction)
  {
    tracer.DrawToPrediction();
  }
  tracer.DrawToSupport();
  execution.Report(0.4);
  const Image<float> distance = Smoothed(tracer.Take(), options.SmoothingPx, execution);
  Image<std::uint8_t> coverage(distance.Width, distance.Height);
  std::transform(distance.Values.begin(), distance.Values.end(), coverage.Values.begin(),
    [](float d)
    { return static_cast<std::uint8_t>(255 * std::max(0.f, std::min(0.5f - d, 1.f))); });
  const auto area = static_cast<double>(std::count_if(coverage.Values.begin(),
    coverage.Values.end(), [](std::uint8_t value) { return value > 127; }));
  RemoveSmallRegions(coverage, true, 0.02 * area);
  RemoveSmallRegions(coverage, false, 0.0005 * area);
  return SignedContourDistance(static_cast<const Image<std::uint8_t>&>(coverage).Ref());
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "stereo/MapComparison.h"

#include "core/ToInt.h"
#include "geometry/ViewSelection.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace novelview
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int Neighbours = 4;         ///< photographs each is compared with
constexpr int Every = 3;              ///< pixels compared, per direction
constexpr double RimPx = 4;           ///< at the rim maps are wrong without being noisy
constexpr std::size_t MinPoints = 50; ///< fewer prove nothing
/** By how much gains must improve the prediction; lamps that do not turn along improve it, too. */
constexpr double MinImprovement = 0.05;

/** A pixel of one map found again in another. */
struct Match
{
  Vector2d Pixel;    ///< in the other photograph
  double Difference; ///< depth there minus depth of the point, world units
  double Confidence; ///< the lesser of the two
};

std::optional<Match> FindAgain(const View& view, int x, int y, const View& other)
{
  const double depth = view.DepthMap(x, y);
  if (depth <= 0 || view.ContourDistance(x, y) < RimPx)
  {
    return std::nullopt;
  }
  const Vector3d point = view.Cam.Unproject(Vector2d(x, y), depth);
  const double z = other.Cam.Depth(point);
  if (z <= 0)
  {
    return std::nullopt;
  }
  const Vector2d pixel = other.Cam.Project(point);
  const int i = FloorToInt(pixel.x() + 0.5);
  const int j = FloorToInt(pixel.y() + 0.5);
  if (!other.DepthMap.Contains(i, j) || other.DepthMap(i, j) <= 0 ||
    other.ContourDistance(i, j) < RimPx)
  {
    return std::nullopt;
  }
  return Match{ pixel, SampleBilinear(other.DepthMap, pixel.x(), pixel.y()) - z,
    std::min<double>(view.Confidence(x, y), other.Confidence(i, j)) };
}

/** Calls take(x, y, match) for the pixels of a view that another view's map shows as well. */
template <class Take>
void ForEachMatch(const View& view, const View& other, const Take& take)
{
  for (int y = 0; y < view.DepthMap.Height; y += Every)
  {
    for (int x = 0; x < view.DepthMap.Width; x += Every)
    {
      if (const auto match = FindAgain(view, x, y, other))
      {
        take(x, y, *match);
      }
    }
  }
}

std::optional<double> MedianOf(std::vector<double>& values)
{
  if (values.size() < MinPoints)
  {
    return std::nullopt;
  }
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** A pixel's brightness, mean of the channels; 0 where the sensor clips or sees next to nothing. */
double Brightness(const View& view, const Vector2d& pixel)
{
  double sum = 0;
  for (int channel = 0; channel < 3; ++channel)
  {
    sum += SampleBilinear(view.Color, pixel.x(), pixel.y(), channel) / 3;
  }
  return sum > 15 && sum < 240 ? sum : 0;
}

/** Whether a point found again is the same surface, so that its colours can be compared. */
bool IsSameSurface(const Match& match, double footprint)
{
  return std::abs(match.Difference) < 2 * footprint && match.Confidence > 0.2;
}

/** The logarithmic ratios of two photographs' brightness at the points both show. */
std::vector<double> LogRatios(const View& view, const View& other, double footprint)
{
  std::vector<double> ratios;
  ForEachMatch(view, other,
    [&](int x, int y, const Match& match)
    {
      const double own = Brightness(view, Vector2d(x, y));
      const double others = Brightness(other, match.Pixel);
      if (IsSameSurface(match, footprint) && own > 0 && others > 0)
      {
        ratios.push_back(std::log(own / others));
      }
    });
  return ratios;
}

/** Sums of squared errors of a prediction: with the photographs as they are, and with gains. */
struct PredictionErrors
{
  double AsTheyAre = 0;
  double WithGains = 0;
};

/** Predicts the brightness of one photograph's pixels by the blend of what its neighbours show. */
PredictionErrors PredictPhotograph(const std::vector<View>& views, std::size_t viewId,
  const std::vector<int>& neighbours, const std::vector<double>& gains, double footprint)
{
  struct Blend
  {
    double Weight = 0;
    double AsTheyAre = 0;
    double WithGains = 0;
  };
  const View& view = views[viewId];
  Image<Blend> blends(view.DepthMap.Width, view.DepthMap.Height);
  for (const int j : neighbours)
  {
    const double cosine = view.Cam.OpticalAxis().dot(views[j].Cam.OpticalAxis());
    const double weight = std::pow(std::max(cosine, 0.0), 16);
    ForEachMatch(view, views[j],
      [&](int x, int y, const Match& match)
      {
        const double brightness = Brightness(views[j], match.Pixel);
        if (IsSameSurface(match, footprint) && brightness > 0)
        {
          Blend& blend = blends(x, y);
          blend.Weight += weight;
          blend.AsTheyAre += weight * brightness;
          blend.WithGains += weight * brightness / gains[j];
        }
      });
  }
  PredictionErrors errors;
  for (int y = 0; y < blends.Height; y += Every)
  {
    for (int x = 0; x < blends.Width; x += Every)
    {
      const Blend& blend = blends(x, y);
      const double own = blend.Weight > 0 ? Brightness(view, Vector2d(x, y)) : 0;
      if (own > 0)
      {
        errors.AsTheyAre += std::pow(blend.AsTheyAre / blend.Weight - own, 2);
        errors.WithGains += std::pow(blend.WithGains / blend.Weight - own, 2);
      }
    }
  }
  return errors;
}
}

double DepthNoise(const std::vector<View>& views, double footprint, const Execution& execution)
{
  const auto neighbours = NearestNeighbours(views, Neighbours);
  std::vector<std::vector<double>> perView(views.size());
  execution.ForEach(static_cast<std::int64_t>(views.size()),
    [&](std::int64_t i)
    {
      for (const int j : neighbours[i])
      {
        ForEachMatch(views[i], views[j],
          [&](int x, int y, const Match& match)
          {
            // Far in front of the point lies what hides it.
            if (views[i].Confidence(x, y) > 0.05 && match.Difference > -15 * footprint)
            {
              perView[i].push_back(std::abs(match.Difference) / footprint);
            }
          });
      }
    });
  std::vector<double> all;
  for (const auto& part : perView)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return MedianOf(all).value_or(0);
}

std::vector<double> ExposureGains(
  const std::vector<View>& views, double footprint, const Execution& execution)
{
  if (views.empty())
  {
    return {};
  }
  const auto count = static_cast<Eigen::Index>(views.size());
  const auto neighbours = NearestNeighbours(views, Neighbours);
  std::vector<std::vector<std::pair<double, double>>> medians(views.size()); // and their weights
  execution.ForEach(count,
    [&](std::int64_t i)
    {
      for (const int j : neighbours[i])
      {
        std::vector<double> ratios = LogRatios(views[i], views[j], footprint);
        const double weight = std::sqrt(static_cast<double>(ratios.size()));
        const auto median = MedianOf(ratios);
        medians[i].emplace_back(median.value_or(0), median ? weight : 0);
      }
    });
  // Normal equations of sum w (g_i - g_j - median)^2, held to zero mean by a weak pull to 0.
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i)
  {
    for (std::size_t n = 0; n < neighbours[i].size(); ++n)
    {
      const int j = neighbours[i][n];
      const auto [median, weight] = medians[i][n];
      normal(i, i) += weight;
      normal(j, j) += weight;
      normal(i, j) -= weight;
      normal(j, i) -= weight;
      right[i] += weight * median;
      right[j] -= weight * median;
    }
  }
  normal.diagonal().array() += 1e-6 * normal.trace() / static_cast<double>(count) + 1e-9;
  Eigen::VectorXd logGains = normal.ldlt().solve(right);
  logGains.array() -= logGains.mean();
  std::vector<double> gains(views.size());
  std::transform(
    logGains.begin(), logGains.end(), gains.begin(), [](double value) { return std::exp(value); });
  return gains;
}

bool GainsPredictBetter(const std::vector<View>& views, const std::vector<double>& gains,
  double footprint, const Execution& execution)
{
  const auto neighbours = NearestNeighbours(views, Neighbours);
  std::vector<PredictionErrors> perView(views.size());
  execution.ForEach(static_cast<std::int64_t>(views.size()),
    [&](std::int64_t i)
    { perView[i] = PredictPhotograph(views, i, neighbours[i], gains, footprint); });
  PredictionErrors sum;
  for (const PredictionErrors& each : perView)
  {
    sum.AsTheyAre += each.AsTheyAre;
    sum.WithGains += each.WithGains;
  }
  return sum.WithGains < (1 - MinImprovement) * sum.AsTheyAre;
}
}

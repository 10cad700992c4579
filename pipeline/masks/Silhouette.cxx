// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/Silhouette.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "images/OpenCvPixels.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace novelview
{
namespace
{
using Pixel = cv::Vec3b;

/** Width of the border that the background's colour is learnt from. */
int BorderPx(const cv::Mat& photo)
{
  return std::max(2, std::min(photo.cols, photo.rows) / 50);
}

cv::Mat BorderMask(const cv::Mat& photo)
{
  cv::Mat border(photo.size(), CV_8U, cv::Scalar(255));
  const int width = BorderPx(photo);
  const cv::Rect middle(width, width, photo.cols - 2 * width, photo.rows - 2 * width);
  if (middle.width > 0 && middle.height > 0)
  {
    border(middle).setTo(0);
  }
  return border;
}

int Difference(const Pixel& a, const cv::Vec3d& b)
{
  double largest = 0;
  for (int channel = 0; channel < 3; ++channel)
  {
    largest = std::max(largest, std::abs(a[channel] - b[channel]));
  }
  return static_cast<int>(std::lround(largest));
}

/** Mean of the colours within `radius` levels of `around`. */
cv::Vec3d MeanAround(const std::vector<Pixel>& colours, const cv::Vec3d& around, int radius)
{
  cv::Vec3d sum(0, 0, 0);
  double count = 0;
  for (const Pixel& colour : colours)
  {
    if (Difference(colour, around) <= radius)
    {
      sum += cv::Vec3d(colour);
      count += 1;
    }
  }
  return count > 0 ? sum / count : around;
}

/**
 * The most frequent colour of the border: the fullest bin, then a few steps of mean shift. Only
 * colours with no channel at `limit` or above count.
 */
cv::Vec3d BackgroundColour(const cv::Mat& photo, const cv::Mat& border, int limit = 256)
{
  constexpr int binLevels = 16;
  std::vector<Pixel> colours;
  std::map<int, int> bins;
  for (int y = 0; y < photo.rows; ++y)
  {
    for (int x = 0; x < photo.cols; ++x)
    {
      if (border.at<std::uint8_t>(y, x))
      {
        const Pixel& colour = photo.at<Pixel>(y, x);
        if (std::max({ colour[0], colour[1], colour[2] }) >= limit)
        {
          continue;
        }
        colours.push_back(colour);
        ++bins[colour[0] / binLevels * 256 + colour[1] / binLevels * 16 + colour[2] / binLevels];
      }
    }
  }
  if (bins.empty())
  {
    throw Error("background", "nothing along the photograph's border is dark",
      "no colour below " + std::to_string(limit), "a dark background");
  }
  const auto fullest = std::max_element(
    bins.begin(), bins.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const int bin = fullest->first;
  cv::Vec3d colour =
    (cv::Vec3d(bin / 256, bin / 16 % 16, bin % 16) + cv::Vec3d(0.5, 0.5, 0.5)) * binLevels;
  for (int step = 0; step < 5; ++step)
  {
    colour = MeanAround(colours, colour, binLevels);
  }
  return colour;
}

/**
 * Difference from the background, 8 bits. With `shadows`, a pixel c is split into the shade of the
 * background s b that is nearest to it and a rest; for a plausible shadow only the rest counts.
 */
cv::Mat DifferenceFrom(const cv::Mat& photo, const cv::Vec3d& background, bool shadows)
{
  // From here on a colour is clear enough to recognise its shades, and a cast shadow still has
  // some light: no shadow outdoors or in a studio is darker than a quarter.
  constexpr double clearChroma = 48;
  constexpr double darkestShadow = 0.25;
  const auto [least, most] = std::minmax({ background[0], background[1], background[2] });
  shadows = shadows && most - least >= clearChroma;
  cv::Mat difference(photo.size(), CV_8U);
  for (int y = 0; y < photo.rows; ++y)
  {
    for (int x = 0; x < photo.cols; ++x)
    {
      const Pixel& colour = photo.at<Pixel>(y, x);
      const double shade = cv::Vec3d(colour).dot(background) / background.dot(background);
      const bool shadow = shadows && shade < 1 && shade > darkestShadow;
      difference.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(
        Difference(colour, shadow ? cv::Vec3d(background * shade) : background));
    }
  }
  return difference;
}

/** Cb and Cr of JPEG, about 0. */
cv::Vec2d ChromaOf(const cv::Vec3d& rgb)
{
  const double luma = 0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2];
  return { 0.564 * (rgb[2] - luma), 0.713 * (rgb[0] - luma) };
}

/**
 * Difference from the key's hue, 8 bits: twice the distance in the chroma plane from the nearest of
 * the key's shades, which are from a third of its chroma to a little more than all of it.
 */
cv::Mat ChromaDifferenceFrom(const cv::Mat& photo, const cv::Vec3d& key)
{
  constexpr double minChroma = 20; // less is grey to a camera with noise and white balance
  constexpr double darkestShade = 0.35;
  constexpr double brightestShade = 1.15;
  const cv::Vec2d chroma = ChromaOf(key);
  const double size = std::sqrt(chroma.dot(chroma));
  if (size < minChroma)
  {
    throw Error("background", "its colour has no hue to tell the object by",
      "chroma " + std::to_string(std::lround(size)),
      "at least " + std::to_string(std::lround(minChroma)));
  }
  cv::Mat difference(photo.size(), CV_8U);
  for (int y = 0; y < photo.rows; ++y)
  {
    for (int x = 0; x < photo.cols; ++x)
    {
      const cv::Vec2d seen = ChromaOf(cv::Vec3d(photo.at<Pixel>(y, x)));
      const double shade =
        std::clamp(seen.dot(chroma) / chroma.dot(chroma), darkestShade, brightestShade);
      const cv::Vec2d off = seen - shade * chroma;
      difference.at<std::uint8_t>(y, x) =
        cv::saturate_cast<std::uint8_t>(2 * std::sqrt(off.dot(off)));
    }
  }
  return difference;
}

/** The components of `candidates` that hold at least one pixel of `sure`. */
cv::Mat ConnectedTo(const cv::Mat& candidates, const cv::Mat& sure)
{
  cv::Mat labels;
  const int count = cv::connectedComponents(candidates, labels, 8);
  std::vector<bool> keep(count, false);
  for (int y = 0; y < labels.rows; ++y)
  {
    for (int x = 0; x < labels.cols; ++x)
    {
      if (sure.at<std::uint8_t>(y, x))
      {
        keep[labels.at<int>(y, x)] = true;
      }
    }
  }
  keep[0] = false;
  cv::Mat result(candidates.size(), CV_8U);
  for (int y = 0; y < labels.rows; ++y)
  {
    for (int x = 0; x < labels.cols; ++x)
    {
      result.at<std::uint8_t>(y, x) = keep[labels.at<int>(y, x)] ? 255 : 0;
    }
  }
  return result;
}

struct Levels
{
  int Noise = 0; ///< median of the background's own differences
  int Low = 0;   ///< above it and connected to what is surely object: object
  int High = 0;  ///< above it: surely object
};

/** Median and median deviation of the border's differences up to a level. */
std::pair<int, int> BackgroundNoise(const cv::Mat& difference, const cv::Mat& border, int upTo)
{
  std::vector<int> background;
  for (int y = 0; y < difference.rows; ++y)
  {
    for (int x = 0; x < difference.cols; ++x)
    {
      const int value = difference.at<std::uint8_t>(y, x);
      if (border.at<std::uint8_t>(y, x) && value <= upTo)
      {
        background.push_back(value);
      }
    }
  }
  if (background.empty())
  {
    return { 0, 0 };
  }
  const auto median = [&background]
  {
    const auto middle = background.begin() + background.size() / 2;
    std::nth_element(background.begin(), middle, background.end());
    return *middle;
  };
  const int noise = median();
  for (int& value : background)
  {
    value = std::abs(value - noise);
  }
  return { noise, median() };
}

cv::Mat ObjectAt(const cv::Mat& difference, int low, int high)
{
  return LargestComponent(ConnectedTo(difference > low, difference > high));
}

/**
 * How well the outline of a mask follows edges: mean over its contour of log(1 + contrast / noise),
 * contrast = range of the difference in the 3 x 3 pixels around. Contour along the frame is none.
 */
double EdgeScore(const cv::Mat& mask, const cv::Mat& contrast, double noise)
{
  cv::Mat inner;
  cv::erode(mask, inner, cv::Mat());
  double sum = 0;
  double count = 0;
  for (int y = 1; y + 1 < mask.rows; ++y)
  {
    for (int x = 1; x + 1 < mask.cols; ++x)
    {
      if (mask.at<std::uint8_t>(y, x) && !inner.at<std::uint8_t>(y, x))
      {
        sum += std::log1p(contrast.at<std::uint8_t>(y, x) / noise);
        count += 1;
      }
    }
  }
  return count > 0 ? sum / count : 0;
}

/**
 * The level whose outline follows the edges of the picture best. Too low a level runs through the
 * folds of a backdrop, too high a one through the shading of the object; both are smooth. Among
 * about equals (a tenth) the lowest, which keeps the dark parts.
 */
int LevelAlongEdges(const cv::Mat& difference, int lowest, int high, double noise)
{
  constexpr double aboutEqual = 0.9;
  cv::Mat least;
  cv::Mat most;
  cv::erode(difference, least, cv::Mat());
  cv::dilate(difference, most, cv::Mat());
  const cv::Mat contrast = most - least;
  std::vector<std::pair<int, double>> scores;
  double best = 0;
  for (int level = lowest; level <= high; level += std::max(1, level / 6))
  {
    scores.emplace_back(level, EdgeScore(ObjectAt(difference, level, high), contrast, noise));
    best = std::max(best, scores.back().second);
  }
  for (const auto& [level, score] : scores)
  {
    if (score >= aboutEqual * best)
    {
      return level;
    }
  }
  return high;
}

Levels ChooseLevels(
  const cv::Mat& difference, const cv::Mat& border, const std::optional<double>& level)
{
  Levels levels;
  if (level)
  {
    levels.Low = levels.High = static_cast<int>(std::ceil(*level)) - 1;
    return levels;
  }
  cv::Mat unused;
  levels.High = static_cast<int>(
    cv::threshold(difference, unused, 0, 255, cv::THRESH_BINARY | cv::THRESH_OTSU));
  const auto [noise, spread] = BackgroundNoise(difference, border, levels.High);
  levels.Noise = noise;
  // Six standard deviations of the noise (1.48 median deviations each), and two levels for what
  // rounding hides.
  const double deviations = 6 * 1.48 * spread + 2;
  const int lowest = std::min(levels.High, noise + static_cast<int>(deviations));
  levels.Low = LevelAlongEdges(difference, lowest, levels.High, deviations);
  return levels;
}

/** Fills the enclosed background components below a part of the object's area. */
void FillSmallHoles(cv::Mat& mask, double smallHole)
{
  const double limit = smallHole * cv::countNonZero(mask);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  const int count = cv::connectedComponentsWithStats(mask == 0, labels, stats, centroids, 4);
  for (int label = 1; label < count; ++label)
  {
    const int left = stats.at<int>(label, cv::CC_STAT_LEFT);
    const int top = stats.at<int>(label, cv::CC_STAT_TOP);
    const bool open = left == 0 || top == 0 ||
      left + stats.at<int>(label, cv::CC_STAT_WIDTH) == mask.cols ||
      top + stats.at<int>(label, cv::CC_STAT_HEIGHT) == mask.rows;
    if (!open && stats.at<int>(label, cv::CC_STAT_AREA) < limit)
    {
      mask.setTo(255, labels == label);
    }
  }
}

/** Closing that treats the frame as neither object nor background. */
cv::Mat Close(const cv::Mat& mask, int radiusPx)
{
  if (radiusPx < 1)
  {
    return mask;
  }
  const int size = 2 * radiusPx + 1;
  cv::Mat padded;
  cv::copyMakeBorder(mask, padded, size, size, size, size, cv::BORDER_REPLICATE);
  cv::morphologyEx(padded, padded, cv::MORPH_CLOSE,
    cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(size, size)));
  return padded(cv::Rect(size, size, mask.cols, mask.rows)).clone();
}

/**
 * Coverage near the mask's rim: the difference over the largest one of the object close by, so that
 * 0.5 is the half height of the edge. Elsewhere the mask itself.
 */
cv::Mat SoftenRim(const cv::Mat& mask, const cv::Mat& difference, int noise)
{
  // The blur of a photograph: the rim lies within two pixels of where a low level puts it, and the
  // object's full difference is reached within two more.
  constexpr int rimPx = 2;
  const auto disc = [](int radiusPx)
  {
    return cv::getStructuringElement(
      cv::MORPH_ELLIPSE, cv::Size(2 * radiusPx + 1, 2 * radiusPx + 1));
  };
  cv::Mat outer;
  cv::Mat inner;
  cv::Mat object;
  cv::Mat full;
  cv::dilate(mask, outer, disc(1));
  cv::erode(mask, inner, disc(rimPx));
  cv::bitwise_and(difference, mask, object);
  cv::dilate(object, full, disc(rimPx));
  cv::Mat result = mask.clone();
  for (int y = 0; y < mask.rows; ++y)
  {
    for (int x = 0; x < mask.cols; ++x)
    {
      const int height = full.at<std::uint8_t>(y, x) - noise;
      if (outer.at<std::uint8_t>(y, x) && !inner.at<std::uint8_t>(y, x) && height > 0)
      {
        const double coverage = (difference.at<std::uint8_t>(y, x) - noise) / double(height);
        result.at<std::uint8_t>(y, x) =
          static_cast<std::uint8_t>(std::lround(255 * std::clamp(coverage, 0.0, 1.0)));
      }
    }
  }
  return result;
}

/** Mean colour of the background-to-be around every pixel, without the object's own light. */
cv::Mat SmoothOutside(const cv::Mat& photo, const cv::Mat& outside, double sigmaPx)
{
  cv::Mat weight;
  cv::Mat colour;
  outside.convertTo(weight, CV_32F, 1.0 / 255);
  photo.convertTo(colour, CV_32F);
  colour.setTo(cv::Scalar::all(0), outside == 0);
  cv::GaussianBlur(weight, weight, cv::Size(), sigmaPx, sigmaPx, cv::BORDER_REFLECT);
  cv::GaussianBlur(colour, colour, cv::Size(), sigmaPx, sigmaPx, cv::BORDER_REFLECT);
  cv::Mat weights;
  cv::merge(std::vector<cv::Mat>(3, cv::max(weight, 1e-6)), weights);
  return colour / weights;
}

/** Mean and standard deviation of what lies within three deviations of the rest, a few rounds. */
std::pair<double, double> ClippedNoise(const cv::Mat& values, const cv::Mat& where)
{
  cv::Mat used = where.clone();
  cv::Scalar mean;
  cv::Scalar deviation;
  for (int round = 0; round < 5; ++round)
  {
    cv::meanStdDev(values, mean, deviation, used);
    used = where & (values <= mean[0] + 3 * deviation[0]);
  }
  return { mean[0], deviation[0] };
}

int PixelsAtFrame(const cv::Mat& mask)
{
  return cv::countNonZero(mask.row(0)) + cv::countNonZero(mask.row(mask.rows - 1)) +
    cv::countNonZero(mask.col(0)) + cv::countNonZero(mask.col(mask.cols - 1));
}

/**
 * Adds the parts of the object that lie in such deep shadow that single pixels drown in the noise:
 * smoothed, they still differ from the background. Taken are large regions next to the object that
 * reach the frame no more than the object itself does, which folds of a backdrop do.
 */
void AddFaintParts(cv::Mat& mask, const cv::Mat& photo, const cv::Mat& border)
{
  constexpr double smoothingPx = 2;
  constexpr int blurPx = 3;        // how far the light of the object may reach by blur
  constexpr double minArea = 0.01; // of the object; smaller regions are reflections
  cv::Mat near;
  cv::dilate(mask, near,
    cv::getStructuringElement(cv::MORPH_ELLIPSE, cv::Size(2 * blurPx + 1, 2 * blurPx + 1)));
  const cv::Mat outside = near == 0;
  const cv::Mat ground = outside & border;
  const double objectArea = cv::countNonZero(mask > 127);
  if (cv::countNonZero(ground) == 0 || objectArea == 0)
  {
    return;
  }
  const cv::Mat smooth = SmoothOutside(photo, outside, smoothingPx);
  const cv::Mat background(photo.size(), CV_32FC3, cv::mean(smooth, ground));
  std::vector<cv::Mat> channels;
  cv::split(cv::abs(smooth - background), channels);
  const cv::Mat difference = cv::max(cv::max(channels[0], channels[1]), channels[2]);
  const auto [noise, deviation] = ClippedNoise(difference, ground);
  cv::Mat labels;
  cv::Mat stats;
  cv::Mat centroids;
  // Six deviations of the smoothed noise, and half a level that rounding may hide.
  const cv::Mat faint = outside & (difference > noise + 6 * deviation + 0.5);
  const int count = cv::connectedComponentsWithStats(faint, labels, stats, centroids, 4);
  cv::Mat touching;
  cv::dilate(near, touching, cv::Mat());
  for (int label = 1; label < count; ++label)
  {
    cv::Mat region = labels == label;
    if (stats.at<int>(label, cv::CC_STAT_AREA) < minArea * objectArea ||
      PixelsAtFrame(region) > PixelsAtFrame(mask) || cv::countNonZero(region & touching) == 0)
    {
      continue;
    }
    // Its rim, too, is at half its height.
    const double height = cv::mean(difference, region)[0] - noise;
    region &= difference > noise + height / 2;
    // What lies between the region and the object was too near to the object's light to judge.
    cv::Mat seam;
    cv::dilate(region, seam, cv::Mat(), cv::Point(-1, -1), blurPx + 1);
    mask.setTo(255, region | (seam & near & (mask < 128)));
  }
}
}

Image<std::uint8_t> ExtractSilhouette(
  const ImageRef<const std::uint8_t>& photo, const SilhouetteOptions& options)
{
  const cv::Mat pixels = ToMat(photo);
  const cv::Mat border = BorderMask(pixels);
  constexpr int darkBackground = 64;
  using Backdrop = SilhouetteOptions::Backdrop;
  const bool chroma = options.Background == Backdrop::Chroma;
  const cv::Vec3d background = chroma && options.Key
    ? cv::Vec3d((*options.Key)[0], (*options.Key)[1], (*options.Key)[2])
    : BackgroundColour(pixels, border, options.Background == Backdrop::Dark ? darkBackground : 256);
  const cv::Mat difference = chroma ? ChromaDifferenceFrom(pixels, background)
                                    : DifferenceFrom(pixels, background, options.IgnoreShadows);
  const Levels levels = ChooseLevels(difference, border, options.Level);
  cv::Mat mask = ObjectAt(difference, levels.Low, levels.High);
  mask = LargestComponent(Close(mask, options.ClosingPx));
  FillSmallHoles(mask, options.SmallHole);
  if (!options.Level)
  {
    mask = SoftenRim(mask, difference, levels.Noise);
    // Softening may cut off specks that hung on by the blur alone.
    const cv::Mat body = LargestComponent(mask > 127);
    cv::Mat reach;
    cv::dilate(body, reach, cv::Mat());
    mask.setTo(0, reach == 0);
    // Shadowed parts vanish before a dark background only; before a bright one they stand out, and
    // what is faint there is the shadow that the object casts.
    if (!chroma && std::max({ background[0], background[1], background[2] }) < darkBackground)
    {
      AddFaintParts(mask, pixels, border);
    }
  }
  return FromMat<std::uint8_t>(mask);
}

Coverage MeasureCoverage(const ImageRef<const std::uint8_t>& mask)
{
  Coverage coverage;
  std::int64_t count = 0;
  for (int y = 0; y < mask.Height; ++y)
  {
    for (int x = 0; x < mask.Width; ++x)
    {
      if (mask(x, y) > 127)
      {
        ++count;
        coverage.Left |= x == 0;
        coverage.Right |= x == mask.Width - 1;
        coverage.Top |= y == 0;
        coverage.Bottom |= y == mask.Height - 1;
      }
    }
  }
  coverage.Fraction = double(count) / (double(mask.Width) * mask.Height);
  return coverage;
}

std::vector<std::string> CheckCoverage(const Coverage& coverage, const std::string& where)
{
  if (coverage.Fraction == 0)
  {
    throw Error(where, "silhouette is empty");
  }
  if (coverage.Fraction == 1)
  {
    throw Error(where, "silhouette fills the whole frame");
  }
  std::vector<std::string> words;
  if (coverage.TouchesBorder())
  {
    std::string sides;
    const std::pair<bool, const char*> each[] = { { coverage.Left, "left" },
      { coverage.Right, "right" }, { coverage.Top, "top" }, { coverage.Bottom, "bottom" } };
    for (const auto& [touches, name] : each)
    {
      sides += touches ? (sides.empty() ? "" : ", ") + std::string(name) : "";
    }
    words.push_back(where + ": the object leaves the frame (" + sides +
      "); what lies outside it is treated as unknown");
  }
  // Objects that fill less than a two-hundredth of the frame, or all but a tenth of it, are more
  // often a silhouette gone wrong than an object.
  if (coverage.Fraction < 0.005 || coverage.Fraction > 0.9)
  {
    words.push_back(where + ": the silhouette covers " +
      Formatted("%.2f %%", 100 * coverage.Fraction) + " of the frame; is that the object?");
  }
  return words;
}
}

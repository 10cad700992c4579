// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/Lens.h"

#include "base/NumberText.h"
#include "core/Error.h"
#include "images/OpenCvPixels.h"

#include <Eigen/Dense>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace novelview
{
namespace
{
/** The numbers of coefficients that OpenCV's perspective model comes with. */
constexpr std::array<std::size_t, 5> PerspectiveCounts{ 4, 5, 8, 12, 14 };
constexpr std::size_t FisheyeCount = 4;
constexpr double MaxCoefficient = 1e6; ///< of either sign; those of real lenses are far below

/** The coefficients with zeros at the end, as many as OpenCV expects. */
cv::Mat Padded(const Lens& lens)
{
  const std::size_t count = lens.Coefficients.size();
  std::size_t length = FisheyeCount;
  if (lens.Kind == Lens::Model::Perspective)
  {
    length = *std::lower_bound(PerspectiveCounts.begin(), PerspectiveCounts.end(), count);
  }
  cv::Mat padded = cv::Mat::zeros(static_cast<int>(length), 1, CV_64F);
  std::copy(lens.Coefficients.begin(), lens.Coefficients.end(), padded.ptr<double>());
  return padded;
}

cv::Matx33d ToMatx(const Eigen::Matrix3d& K)
{
  return { K(0, 0), K(0, 1), K(0, 2), 0, K(1, 1), K(1, 2), 0, 0, 1 };
}

/** How far from the axis the lens shows a point that is `r` from it, at depth 1; radial part only. */
double Radial(const cv::Mat& k, Lens::Model kind, double r)
{
  const auto at = [&k](int i) { return i < k.rows ? k.at<double>(i) : 0.0; };
  if (kind == Lens::Model::Fisheye)
  {
    const double t = std::atan(r);
    const double t2 = t * t;
    return t * (1 + t2 * (at(0) + t2 * (at(1) + t2 * (at(2) + t2 * at(3)))));
  }
  const double r2 = r * r;
  return r * (1 + r2 * (at(0) + r2 * (at(1) + r2 * at(4)))) /
    (1 + r2 * (at(5) + r2 * (at(6) + r2 * at(7))));
}

/**
 * A polynomial that bends back shows things once more from some distance on: copies of the object
 * outside of what the lens sees. Pixels of the pinhole from there on are sent out of the photograph.
 */
void CutFold(const Lens& lens, const Eigen::Matrix3d& K, cv::Mat& across, cv::Mat& down)
{
  constexpr int Steps = 4096; // fine against the pixels of any frame's half diagonal
  constexpr float Outside = -1e4f;
  const cv::Mat k = Padded(lens);
  const Eigen::Matrix3d inverse = K.inverse();
  const auto distance = [&inverse](int x, int y)
  { return (inverse * Eigen::Vector3d(x, y, 1)).head<2>().norm(); };
  double most = 0;
  for (const int x : { 0, across.cols - 1 })
  {
    for (const int y : { 0, across.rows - 1 })
    {
      most = std::max(most, distance(x, y));
    }
  }
  int step = 1;
  while (step <= Steps &&
    Radial(k, lens.Kind, most * step / Steps) > Radial(k, lens.Kind, most * (step - 1) / Steps))
  {
    ++step;
  }
  for (int y = 0; y < across.rows && step <= Steps; ++y)
  {
    for (int x = 0; x < across.cols; ++x)
    {
      if (distance(x, y) >= most * (step - 1) / Steps)
      {
        across.at<float>(y, x) = down.at<float>(y, x) = Outside;
      }
    }
  }
}

/** K without its skew: OpenCV's lens models know none. */
cv::Matx33d WithoutSkew(const Eigen::Matrix3d& K)
{
  cv::Matx33d straight = ToMatx(K);
  straight(0, 1) = 0;
  return straight;
}
}

bool Lens::IsPinhole() const
{
  return this->Kind == Model::Perspective &&
    std::all_of(this->Coefficients.begin(), this->Coefficients.end(),
      [](double coefficient) { return coefficient == 0; });
}

Lens Trimmed(Lens lens)
{
  while (!lens.Coefficients.empty() && lens.Coefficients.back() == 0)
  {
    lens.Coefficients.pop_back();
  }
  return lens;
}

void ValidateLens(const Lens& lens, const std::string& where)
{
  const std::size_t most =
    lens.Kind == Lens::Model::Fisheye ? FisheyeCount : PerspectiveCounts.back();
  if (lens.Coefficients.size() > most)
  {
    throw Error(where, "too many distortion coefficients", std::to_string(lens.Coefficients.size()),
      "at most " + std::to_string(most));
  }
  for (const double coefficient : lens.Coefficients)
  {
    if (!std::isfinite(coefficient))
    {
      throw Error(where, "distortion has numbers that are not finite");
    }
    if (std::abs(coefficient) > MaxCoefficient)
    {
      throw Error(
        where, "distortion coefficient is out of range", NumberText(coefficient), "-1e6 to 1e6");
    }
  }
}

Eigen::Vector2d Distort(const Lens& lens, const Eigen::Matrix3d& K, const Eigen::Vector2d& pixel)
{
  if (lens.IsPinhole())
  {
    return pixel;
  }
  const double y = (pixel.y() - K(1, 2)) / K(1, 1);
  const double x = (pixel.x() - K(0, 2) - K(0, 1) * y) / K(0, 0);
  const cv::Vec3d zero(0, 0, 0);
  const std::vector<cv::Point3d> point{ { x, y, 1 } };
  std::vector<cv::Point2d> image;
  // Through the identity as camera matrix, so that the skew can be applied here.
  if (lens.Kind == Lens::Model::Fisheye)
  {
    cv::fisheye::projectPoints(point, image, zero, zero, cv::Matx33d::eye(), Padded(lens));
  }
  else
  {
    cv::projectPoints(point, zero, zero, cv::Matx33d::eye(), Padded(lens), image);
  }
  return (K * Eigen::Vector3d(image[0].x, image[0].y, 1)).head<2>();
}

Image<std::uint8_t> Undistorted(
  const ImageRef<const std::uint8_t>& picture, const Lens& lens, const Eigen::Matrix3d& K)
{
  const cv::Mat distorted = ToMat(picture);
  cv::Mat across, down;
  if (lens.Kind == Lens::Model::Fisheye)
  {
    cv::fisheye::initUndistortRectifyMap(WithoutSkew(K), Padded(lens), cv::Matx33d::eye(),
      ToMatx(K), distorted.size(), CV_32FC1, across, down);
  }
  else
  {
    cv::initUndistortRectifyMap(WithoutSkew(K), Padded(lens), cv::Matx33d::eye(), ToMatx(K),
      distorted.size(), CV_32FC1, across, down);
  }
  if (K(0, 1) != 0)
  {
    across += (down - K(1, 2)) * (K(0, 1) / K(1, 1));
  }
  CutFold(lens, K, across, down);
  cv::Mat straight;
  cv::remap(distorted, straight, across, down, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return FromMat<std::uint8_t>(straight);
}
}

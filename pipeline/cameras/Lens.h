// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Lens_h
#define novelview_Lens_h

#include "core/ImageRef.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace novelview
{
/**
 * How a lens departs from a pinhole, in OpenCV's two models. With (x, y) = the point in the camera
 * frame divided by its depth, and K the camera matrix (its skew included):
 *
 *  Perspective   k1 k2 p1 p2 [k3 [k4 k5 k6 [s1 s2 s3 s4 [tx ty]]]]; r^2 = x^2 + y^2,
 *                x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) / (1 + k4 r^2 + k5 r^4 + k6 r^6)
 *                     + 2 p1 x y + p2 (r^2 + 2 x^2) + s1 r^2 + s2 r^4, y' likewise; then the tilt
 *  Fisheye       k1 k2 k3 k4; theta = atan r,
 *                (x', y') = (x, y) / r * theta (1 + k1 theta^2 + .. + k4 theta^8)
 *
 * and pixel ~ K (x', y', 1). A fisheye lens is no pinhole even when all its numbers are 0.
 */
struct Lens
{
  enum class Model
  {
    Perspective,
    Fisheye
  };

  Model Kind = Model::Perspective;
  std::vector<double> Coefficients; ///< none = no distortion; missing ones at the end are 0

  bool IsPinhole() const;
  bool operator==(const Lens& other) const = default;
};

/** A lens without the zeros at its end. */
Lens Trimmed(Lens lens);

/**
 * Throws Error when the coefficients are not finite, beyond 1e6, or more than the model has.
 */
void ValidateLens(const Lens& lens, const std::string& where);

/** The pixel at which the lens shows what a pinhole of the same K shows at `pixel`. */
Eigen::Vector2d Distort(const Lens& lens, const Eigen::Matrix3d& K, const Eigen::Vector2d& pixel);

/**
 * The image (any number of channels) that a pinhole with the same K would have taken, of the same
 * size. Bilinear; where it shows what the photograph does not hold it is 0.
 */
Image<std::uint8_t> Undistorted(
  const ImageRef<const std::uint8_t>& picture, const Lens& lens, const Eigen::Matrix3d& K);
}

#endif

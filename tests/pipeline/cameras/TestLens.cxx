// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/CalibrationCases.h"

#include <cmath>

using namespace novelview;
using namespace novelview::testing_support;

namespace
{
constexpr int Width = 160;
constexpr int Height = 120;

Eigen::Matrix3d MatrixWith(double skew)
{
  Eigen::Matrix3d k;
  k << 150, skew, 81, 0, 140, 58, 0, 0, 1;
  return k;
}

const Lens Barrel{ Lens::Model::Perspective, { -0.3, 0.08, 0.004, -0.003, 0.01 } };
const Lens Wide{ Lens::Model::Fisheye, { 0.05, -0.02, 0.01, 0.001 } };

/** The lens's formulas written out, in another way than the code's: x, y = ray, depth 1. */
Eigen::Vector2d Formula(const Lens& lens, double x, double y)
{
  const std::vector<double>& k = lens.Coefficients;
  const double r2 = x * x + y * y;
  if (lens.Kind == Lens::Model::Fisheye)
  {
    const double r = std::sqrt(r2);
    const double t = std::atan(r);
    const double d = t + k[0] * std::pow(t, 3) + k[1] * std::pow(t, 5) + k[2] * std::pow(t, 7) +
      k[3] * std::pow(t, 9);
    return { x * d / r, y * d / r };
  }
  const double radial = 1 + k[0] * r2 + k[1] * r2 * r2 + k[4] * r2 * r2 * r2;
  return { x * radial + 2 * k[2] * x * y + k[3] * (r2 + 2 * x * x),
    y * radial + k[2] * (r2 + 2 * y * y) + 2 * k[3] * x * y };
}

Eigen::Vector2d SeenAt(const Lens& lens, const Eigen::Matrix3d& k, const Eigen::Vector2d& pixel)
{
  const Eigen::Vector3d ray = k.inverse() * pixel.homogeneous();
  return (k * Formula(lens, ray.x(), ray.y()).homogeneous()).head<2>();
}

/** The marks of a chessboard: where a pinhole would see its corners. */
std::vector<Eigen::Vector2d> Corners()
{
  std::vector<Eigen::Vector2d> corners;
  for (int y = 22; y <= 98; y += 19)
  {
    for (int x = 25; x <= 139; x += 19)
    {
      corners.emplace_back(x + 0.3, y - 0.2);
    }
  }
  return corners;
}

/** A soft dot at every one of these pixels. */
Image<std::uint8_t> Dots(const std::vector<Eigen::Vector2d>& pixels)
{
  Image<std::uint8_t> picture(Width, Height);
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      double sum = 0;
      for (const Eigen::Vector2d& pixel : pixels)
      {
        sum += 255 * std::exp(-(Eigen::Vector2d(x, y) - pixel).squaredNorm() / (2 * 1.5 * 1.5));
      }
      picture(x, y) = static_cast<std::uint8_t>(std::min(sum, 255.0));
    }
  }
  return picture;
}

/** The middle of the dot near a pixel. */
Eigen::Vector2d MiddleNear(const Image<std::uint8_t>& picture, const Eigen::Vector2d& pixel)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const int cx = static_cast<int>(std::lround(pixel.x()));
  const int cy = static_cast<int>(std::lround(pixel.y()));
  for (int y = cy - 6; y <= cy + 6; ++y)
  {
    for (int x = cx - 6; x <= cx + 6; ++x)
    {
      sum += picture(x, y) * Eigen::Vector3d(x, y, 1);
    }
  }
  return sum.hnormalized();
}
}

TEST(Lens, DistortFollowsTheFormulas)
{
  for (const Lens& lens : { Barrel, Wide })
  {
    for (const double skew : { 0.0, 4.0 })
    {
      for (const Eigen::Vector2d& pixel : Corners())
      {
        const Eigen::Vector2d expected = SeenAt(lens, MatrixWith(skew), pixel);
        // The same formula in another order: rounding alone.
        EXPECT_LE((Distort(lens, MatrixWith(skew), pixel) - expected).norm(), 1e-9);
        // The lens does something: most corners move by pixels.
        EXPECT_TRUE(
          (pixel - Eigen::Vector2d(81, 58)).norm() < 40 || (expected - pixel).norm() > 0.5);
      }
    }
  }
}

TEST(Lens, UndistortedChessboardsHaveTheirCornersWhereAPinholeSeesThem)
{
  for (const Lens& lens : { Barrel, Wide })
  {
    for (const double skew : { 0.0, 4.0 })
    {
      std::vector<Eigen::Vector2d> seen;
      for (const Eigen::Vector2d& corner : Corners())
      {
        seen.push_back(SeenAt(lens, MatrixWith(skew), corner));
      }
      const Image<std::uint8_t> straight = Undistorted(Dots(seen).Ref(), lens, MatrixWith(skew));
      for (const Eigen::Vector2d& corner : Corners())
      {
        // Dots are round in the distorted picture, so a little lopsided in the straight one; the
        // largest offset there is is 0.05 px.
        EXPECT_LE((MiddleNear(straight, corner) - corner).norm(), 0.08)
          << corner.transpose() << " skew " << skew;
      }
    }
  }
}

TEST(Lens, WhatUndistortingExposesIsBlack)
{
  // A pincushion: at the frame's corners the pinhole would see more than the photograph shows.
  const Lens lens{ Lens::Model::Perspective, { 0.3 } };
  const Image<std::uint8_t> white(Width, Height, 1, 255);
  const Image<std::uint8_t> straight = Undistorted(white.Ref(), lens, MatrixWith(0));
  EXPECT_EQ(straight(0, 0), 0);
  EXPECT_EQ(straight(Width - 1, Height - 1), 0);
  EXPECT_EQ(straight(81, 58), 255);
}

TEST(Lens, ThatBendsBackShowsNothingTwice)
{
  // r (1 - 1.5 r^2) grows up to r = sqrt(1 / 4.5) = 0.471, and what is further out would be taken
  // from inside again. (10, 58) is at r = 71 / 150 = 0.473 and (12, 58) at 0.46.
  const Lens lens{ Lens::Model::Perspective, { -1.5 } };
  const Image<std::uint8_t> white(Width, Height, 1, 255);
  const Image<std::uint8_t> straight = Undistorted(white.Ref(), lens, MatrixWith(0));
  EXPECT_EQ(straight(10, 58), 0);
  EXPECT_EQ(straight(0, 0), 0);
  EXPECT_EQ(straight(12, 58), 255);
}

TEST(Lens, KnowsAPinhole)
{
  EXPECT_TRUE(Lens().IsPinhole());
  EXPECT_TRUE((Lens{ Lens::Model::Perspective, { 0, 0, 0, 0 } }).IsPinhole());
  EXPECT_FALSE((Lens{ Lens::Model::Perspective, { 0, 0, 1e-9 } }).IsPinhole());
  // Without coefficients a fisheye lens still maps angles to lengths.
  EXPECT_FALSE((Lens{ Lens::Model::Fisheye, {} }).IsPinhole());
}

TEST(Lens, BadOnesAreRefused)
{
  ExpectError(
    [] {
      ValidateLens({ Lens::Model::Fisheye, { 0, 0, 0, 0, 1 } }, "here");
    },
    "here", "too many distortion coefficients", "got 5, expected at most 4");
  ExpectError(
    [] {
      ValidateLens({ Lens::Model::Perspective, std::vector<double>(15) }, "here");
    },
    "got 15");
  ExpectError(
    [] {
      ValidateLens({ Lens::Model::Perspective, { std::nan("") } }, "here");
    },
    "not finite");
  ExpectError(
    [] {
      ValidateLens({ Lens::Model::Perspective, { 0.1, -1e308 } }, "here");
    },
    "out of range", "got -1e+308, expected -1e6 to 1e6");
}

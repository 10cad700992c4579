// SPDX-License-Identifier: GPL-3.0-or-later
#include "masks/Silhouette.h"

#include "images/OpenCvPixels.h"
#include "masks/BackgroundModel.h"
#include "masks/FaintParts.h"
#include "masks/ForegroundLevels.h"
#include "masks/MaskCleanUp.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace novelview
{
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
  const ForegroundLevels levels = ChooseLevels(difference, border, options.Level);
  cv::Mat mask = ObjectAt(difference, levels.Low, levels.High);
  mask = LargestComponent(CloseGaps(mask, options.ClosingPx));
  FillSmallHoles(mask, options.SmallHole);
  if (!options.Level)
  {
    mask = SoftenBoundary(mask, difference, levels.Noise);
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
}

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Metrics_h
#define novelview_Metrics_h

#include "core/ImageRef.h"

#include <cstdint>

class vtkImageData;

namespace novelview
{
/** An image of the object: colour (3 channels, RGB) and mask (above 127 = object), same size. */
struct MaskedPicture
{
  ImageRef<const std::uint8_t> Color;
  ImageRef<const std::uint8_t> Mask;
};

/** The point arrays Color and Mask of an image block. */
MaskedPicture MaskedPictureOf(vtkImageData* image, const char* where);

/**
 * How near a rendered image R is to the truth T. Both are first blackened outside their own
 * masks; foreground F = mask of T united with mask of R.
 */
struct Scores
{
  double Rms = 0;  ///< sqrt of the mean over F and the three channels of (R - T)^2, 0 to 255
  double Psnr = 0; ///< 20 log10(255 / Rms), dB; at most that of Rms = 1e-9
  /** Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004) of the 8-bit luma, Gaussian
   * window 11 x 11 with sigma 1.5, population covariances, mirrored at the frame; mean over F. */
  double Ssim = 0;
  double Iou = 0;     ///< of the masks: intersection over union
  double Missing = 0; ///< object pixels of T that R lacks, as part of T's
  double Excess = 0;  ///< object pixels of R that T lacks, as part of T's
};

/**
 * Throws Error when sizes differ, an image is smaller than the window, or the true mask is empty.
 */
Scores Compare(const MaskedPicture& rendered, const MaskedPicture& truth);

/** Intersection over union of two masks; 0 when their sizes differ. */
double MaskIou(const Image<std::uint8_t>& a, const Image<std::uint8_t>& b);

/**
 * Per pixel of the foreground the root mean square over the channels of R - T, 0 to 255; 0
 * elsewhere. One channel.
 */
Image<float> ErrorMap(const MaskedPicture& rendered, const MaskedPicture& truth);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PhotoConsistency_h
#define novelview_PhotoConsistency_h

#include "View.h"

#include <vector>

namespace novelview
{
/**
 * Normalised sum of squared differences of two windows (Chia et al. 2013, equation 3):
 *
 *     w = sum M (I_key - I_k)^2 / sqrt(sum M I_key^2 . sum M I_k^2),
 *
 * over the (2 radius + 1)^2 pixels around both centres and the three channels. M is 0 where either
 * pixel is background. The least is 0 (equal windows); 1, the worst, is also what a window with
 * less than a quarter of its pixels in common says: such a window says nothing. `radius` up to 7;
 * more is cut to that.
 */
double WindowDifference(const View& key, const Eigen::Vector2d& keyCentre, const View& other,
  const Eigen::Vector2d& otherCentre, int radius);

/**
 * Similarity of two windows, 0 to 1: the zero-mean normalised cross-correlation over the pixels
 * that are object in both, and 0 where it is negative or the windows have less than a quarter in
 * common. `noise` (variance per value, grey levels squared) is added to both variances so that flat
 * windows say nothing rather than something random.
 */
class WindowMatcher
{
public:
  /** Reads the key window once; `radius` up to 7. */
  WindowMatcher(const View& key, const Eigen::Vector2d& keyCentre, int radius, double noise = 12);

  double Similarity(const View& other, const Eigen::Vector2d& otherCentre) const;

private:
  int Radius;
  double Noise;
  std::vector<float> Key; ///< 3 values per pixel, row by row
  std::vector<char> Valid;
};

/**
 * The point on the key ray (through `keyPixel`) nearest to the ray through `otherPixel`, which is
 * where both see the same surface point. Returns false for (nearly) parallel rays or a point behind
 * either camera.
 */
bool Triangulate(const Camera& key, const Eigen::Vector2d& keyPixel, const Camera& other,
  const Eigen::Vector2d& otherPixel, Eigen::Vector3d& point);
}

#endif

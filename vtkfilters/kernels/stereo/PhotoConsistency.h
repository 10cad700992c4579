// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PhotoConsistency_h
#define novelview_PhotoConsistency_h

#include "geometry/View.h"

namespace novelview
{
/** The three channels of a square window of a photograph, and which of its values are object. */
struct PhotoWindow
{
  static constexpr int MaxRadius = 7;
  static constexpr int MaxColumns = 48; ///< 3 (2 MaxRadius + 1), filled up to whole registers
  static constexpr int MaxValues = (2 * MaxRadius + 1) * MaxColumns;

  bool AllObject;          ///< then Object is not set
  float Values[MaxValues]; ///< row by row, the channels of a pixel beside each other
  float Object[MaxValues]; ///< 1 or 0
};

/**
 * The window around one pixel of a key photograph, to be compared with windows of others: the
 * (2 radius + 1)^2 pixels around both centres, three channels. Only pixels that are object in both
 * count; windows with less than a quarter of their pixels in common say nothing.
 */
class WindowMatcher
{
public:
  /** Reads the key window once; `radius` up to 7, more is cut to that. */
  WindowMatcher(const View& key, const Eigen::Vector2d& keyCentre, int radius);

  /**
   * Normalised sum of squared differences (Chia et al. 2013, equation 3), M = 1 where both are
   * object:
   *
   *     w = sum M (I_key - I_k)^2 / sqrt(sum M I_key^2 . sum M I_k^2),
   *
   * from 0 (equal windows) to 1, which is also what windows get that say nothing.
   */
  double Difference(const View& other, const Eigen::Vector2d& otherCentre) const;

  /**
   * Similarity, 0 to 1: the zero-mean normalised cross-correlation, and 0 where it is negative or
   * the windows say nothing. `noise` (variance per value, grey levels squared) is added to both
   * variances so that flat windows say nothing rather than something random.
   */
  double Similarity(const View& other, const Eigen::Vector2d& otherCentre, double noise = 12) const;

  /**
   * The normalised sum of squared differences of the colours less their windows' means, channel by
   * channel:
   *
   *     w = sum M (J_key - J_k)^2 / (2 sqrt((sum M J_key^2 + noise) (sum M J_k^2 + noise)))
   *
   * with J the colours less the means, from 0 (equal but for brightness) to 1 (unrelated, or the
   * windows say nothing). `noise` as for Similarity().
   */
  double ContrastDifference(
    const View& other, const Eigen::Vector2d& otherCentre, double noise = 12) const;

  /**
   * Variance of the key window's object pixels about the means of their channels, grey levels
   * squared: how much the window can tell. 0 when less than a quarter of it is object.
   */
  double Variance() const;

private:
  int Radius;
  PhotoWindow Key;
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

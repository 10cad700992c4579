// SPDX-License-Identifier: GPL-3.0-or-later
/** The silhouettes of a data set, small enough to be compared many times. */
#ifndef novelview_CheckedSilhouettes_h
#define novelview_CheckedSilhouettes_h

#include "cameras/Photograph.h"
#include "dataset/Dataset.h"
#include "geometry/View.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace novelview
{
/** A silhouette as stored in its file: neither inverted nor undistorted. */
struct FoundMask
{
  Image<std::uint8_t> Pixels; ///< empty = there is none, or it cannot be used
  MaskSource Source = MaskSource::File;
};

/** Silhouettes of a data set at the resolution that they are compared at. */
class CheckedSilhouettes
{
public:
  /** Longer side of the reduced silhouettes, px; smaller ones stay as they are. */
  static constexpr int WorkingSize = 640;

  /**
   * One mask per camera; those without any contour take no part. Cameras give the lenses. `invert`
   * is for what was not extracted.
   */
  CheckedSilhouettes(const std::vector<Photograph>& cameras, const std::vector<FoundMask>& masks,
    bool invert, int workingSize = WorkingSize);

  /** Ids of the cameras whose silhouettes take part. */
  const std::vector<int>& Ids() const { return this->Used; }

  /** Some of them (by id) as views of these cameras. The silhouettes must outlive the views. */
  std::vector<View> ViewsOf(
    const std::vector<Photograph>& cameras, const std::vector<int>& ids) const;

  /** Pixels of the photograph per pixel of its silhouette here, at least 1. */
  double ReductionOf(int id) const { return this->All[id].Reduction; }

  /** Part of the frame's border that is object, 0 to 1. */
  double BorderShareOf(int id) const { return this->All[id].BorderShare; }

  /** Swaps the silhouettes of two cameras. */
  void Swap(int a, int b) { std::swap(this->All[a], this->All[b]); }

  /** Gives a camera that takes part another silhouette; false (and nothing done) without contour. */
  bool Replace(int id, const Photograph& camera, const FoundMask& mask, bool invert);

private:
  struct Reduced
  {
    Image<std::uint8_t> Mask;
    Image<float> Distance;
    double Reduction = 1;
    double BorderShare = 0;
  };
  static Reduced Reduce(
    const Photograph& camera, const FoundMask& found, bool invert, int workingSize);

  int Size;
  std::vector<Reduced> All;
  std::vector<int> Used;
};
}

#endif

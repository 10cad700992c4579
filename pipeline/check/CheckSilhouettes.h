// SPDX-License-Identifier: GPL-3.0-or-later
/** Whether silhouettes and cameras belong together, and which of them do not. */
#ifndef novelview_CheckSilhouettes_h
#define novelview_CheckSilhouettes_h

#include "core/Execution.h"
#include "dataset/Dataset.h"
#include "geometry/View.h"

#include <string>
#include <vector>

namespace novelview
{
/** A silhouette as its file has it: neither inverted nor undistorted. */
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

/** How well a set of views agrees; lists are by view. */
struct AgreementSurvey
{
  /**
   * Intersection over union of the silhouette and the visual hull of all views, projected (which
   * lies inside of it): the part of its pixels whose rays meet the hull within a pixel.
   */
  std::vector<double> Iou;
  double MeanIou = 0;
  /**
   * Part of the other views' contour rays that would meet the hull but for this view, among those
   * whose rays do not.
   */
  std::vector<double> ExclusivelyCarved;
  /** The mean of Iou over the others if this view were left out. */
  std::vector<double> MeanIouWithout;
  /** The best mean with at most one view left out. */
  double RobustIou = 0;
  /** Points on the hull. */
  std::vector<Eigen::Vector3d> Points;
};

/** `rays` is the number per view of each kind (area and contour). */
AgreementSurvey SurveyAgreement(
  const std::vector<View>& views, int rays, const Execution& execution = {});

/** One way to read the calibration. */
struct ConventionTrial
{
  CameraConvention Convention;      ///< complete
  std::vector<std::string> Changes; ///< what differs from how it was read, "axes", "poses" ..
  std::vector<std::string> Options; ///< of the command line, that make the program read it so
  bool Readable = true;             ///< false: cameras would be none
  double Iou = 0;                   ///< RobustIou of the silhouettes with these cameras
};

/**
 * Every way to read the calibration with axes, poses, rotation order and y either as `source` says
 * or the other way; masks are inverted in all or none. The first one is as it is read.
 */
std::vector<ConventionTrial> TryConventions(const std::filesystem::path& folder,
  const DatasetSource& source, const std::vector<std::string>& exclude,
  const std::vector<FoundMask>& masks, bool invert, const Execution& execution = {});

/** The best of them: among about equals (0.02 of IoU) the one with the fewest changes. */
std::size_t ChooseTrial(const std::vector<ConventionTrial>& trials);

/** The convention a calibration is stated in when nothing else is said. */
CameraConvention OwnConvention(const std::filesystem::path& folder, const DatasetSource& source);

/** The options that make the program read a calibration of convention `own` as `wanted`. */
std::vector<std::string> ConventionOptions(
  const CameraConvention& own, const CameraConvention& wanted);

/** The source that is read as `wanted`. */
DatasetSource SourceReadAs(
  const DatasetSource& source, const CameraConvention& own, const CameraConvention& wanted);

/** How silhouettes agree when all principal points are shifted along the pixels' diagonal. */
struct PixelCentreVerdict
{
  std::vector<double>
    LossPx;          ///< per shift: mean over the contour rays of how far they miss the hull
  double Sigmas = 0; ///< by how many standard errors (over the views) the second shift is better
                     ///< than the first
};

/** Measures that for each of the shifts, px of the photographs; at least two. */
PixelCentreVerdict ComparePixelCentres(const std::vector<View>& views,
  const std::vector<double>& shiftsPx, const Execution& execution = {});
}

#endif

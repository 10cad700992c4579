// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_CameraConvention_h
#define novelview_CameraConvention_h

#include "cameras/Photograph.h"

#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/**
 * In which convention a file states its cameras. Every format has its own; what is given here
 * overrides it, for files that depart from their format. "format" and no value mean the
 * format's own.
 */
struct CameraConvention
{
  /** Camera frame: "opencv" = x right, y down, z forward; "opengl" = x right, y up, z backward. */
  std::string Axes = "format";
  /** What [R t] maps: "world-to-camera", or "camera-to-world", where t is the camera's centre. */
  std::string Poses = "format";
  /** "row": R as a matrix is written, row by row; "column": transposed. */
  std::string RotationOrder = "format";
  /** The coordinate of the centre of the top-left pixel, 0 or 0.5. */
  std::optional<double> PixelCentre;
  /** The camera's y and the pixels' v point up (left-handed frames, or images upside down). A
   * world that is left-handed, too, is mirrored in y, so results are as well. */
  bool FlipY = false;
  /** The object is black in the masks. */
  bool InvertMasks = false;
};

/** The project's own convention, which is OpenCV's; see Camera.h. */
CameraConvention ProjectConvention();

/** `own`, except where `given` states another. */
CameraConvention Override(CameraConvention own, const CameraConvention& given);

/**
 * Turns cameras as their file states them (R and T hold the pose's matrix and vector, whatever they
 * map) into the project's convention, all with their lenses. `convention` must be complete. Flipping
 * y needs the photographs' heights: those that are 0 are read from the files. Throws Error, naming
 * the camera, when a pose is singular or the lens cannot be flipped.
 */
void ApplyConvention(const CameraConvention& convention, std::vector<Photograph>& photographs);

/** The other way round, for writing: R, T and K as a file in `convention` (no flip) states them. */
Camera InConvention(const CameraConvention& convention, const Camera& camera);
}

#endif

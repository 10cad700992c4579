// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Photograph_h
#define novelview_Photograph_h

#include "cameras/Lens.h"
#include "geometry/Camera.h"

#include <filesystem>
#include <string>

namespace novelview
{
/** A camera of a calibration file. The image size is 0x0 where the file does not say it. */
struct NamedCamera
{
  std::string Name;
  Camera Cam;
};

/** A photograph of a data set before it is decoded: its camera and where its pixels are. */
struct Photograph : NamedCamera
{
  Lens Distortion;            ///< undistorted on reading; afterwards Cam is all there is
  std::filesystem::path File; ///< the photograph
  std::filesystem::path Mask; ///< its silhouette; empty = its alpha channel or, without, extracted
  bool InvertMask = false;    ///< object is black (or, as alpha, transparent)
  std::string Where;          ///< of the calibration, for messages: file and line
};
}

#endif

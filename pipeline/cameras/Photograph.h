// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Photograph_h
#define novelview_Photograph_h

#include "cameras/Lens.h"
#include "geometry/Camera.h"
#include "images/ImageFile.h"

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

/** What was ignored, guessed or changed when a data set was read. */
struct ReadingNote
{
  std::string Kind;     ///< a word for programs, as in CheckFinding
  std::string Text;     ///< one sentence
  bool Harmful = false; ///< results may suffer
};

/** A photograph of a data set before it is decoded: its camera and where its pixels are. */
struct Photograph : NamedCamera
{
  Lens Distortion;            ///< undistorted on reading; afterwards Cam is all there is
  std::filesystem::path File; ///< the photograph
  std::filesystem::path Mask; ///< its silhouette; empty = its alpha channel or, without, extracted
  ColorReading Reading;       ///< how its colours are read; the mask is as it is
  bool InvertMask = false;    ///< object is black (or, as alpha, transparent)
  /** Size of the file where Cam is for a smaller picture, to which it is reduced; 0 = Cam's. */
  int FileWidth = 0;
  int FileHeight = 0;
  std::string Where; ///< of the calibration, for messages: file and line
};
}

#endif

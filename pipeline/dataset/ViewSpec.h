// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_ViewSpec_h
#define novelview_ViewSpec_h

#include "dataset/Dataset.h"
#include "geometry/Camera.h"
#include "options/Options.h"

#include <filesystem>
#include <string>

namespace novelview
{
/**
 * Which novel view is wanted:
 *
 *     between:A,B[,F]   the camera a fraction F (default 0.5) of the way from camera A to camera B
 *                       on their orbit; A and B are names of photographs or numbers from 0
 *     like:IMAGE        the camera of a photograph, which is held out of every stage and is the
 *                       truth to compare with
 *     file:PAR.txt#NAME a camera of a calibration file of any format; an image NAME beside it is
 *                       the truth
 */
struct ViewSpec
{
  enum class Kind
  {
    None,
    Between,
    Like,
    File
  };

  Kind What = Kind::None;
  std::string From;
  std::string To;
  double Fraction = 0.5;
  std::string Name;              ///< of Like and File
  std::filesystem::path ParFile; ///< of File
};

/** Throws UsageError when the text is none of the three forms. */
ViewSpec ParseViewSpec(const std::string& text);
/** The text that ParseViewSpec() reads. Empty for None. */
std::string ViewSpecText(const ViewSpec& spec);

/** A view as the value of an option. */
WordTarget ViewTarget(ViewSpec& view);

/** A novel view, ready to be made. */
struct ResolvedView
{
  Camera Cam;          ///< with its image's size
  std::string HeldOut; ///< photograph that no stage may see; empty = none
  Photograph Truth;    ///< image to compare with; File is empty when none is known
};

/** The view of a camera that may have a photograph, as of `file:`. */
ResolvedView ResolveCamera(Photograph found, const DatasetIndex& dataset);

/**
 * Looks the cameras of a view up. The image's size is that of the photograph A, of IMAGE, of the
 * image NAME or, where there is none, of the first photograph of the data set. Throws UsageError
 * when a name or number is unknown, Error when A and B have frames that cannot be averaged.
 */
ResolvedView ResolveViewSpec(const ViewSpec& spec, const DatasetIndex& dataset);
}

#endif

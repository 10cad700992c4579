// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Data sets: a folder with photographs, their calibration in one of several formats, and perhaps
 * masks. DatasetFormats.h lists the formats; this file contains what they have in common.
 *
 * Errors are novelview::Error, naming file and line or photograph.
 */
#ifndef novelview_Dataset_h
#define novelview_Dataset_h

#include "cameras/CameraConvention.h"
#include "cameras/Photograph.h"
#include "cameras/PhotographFiles.h"
#include "masks/Coverage.h"
#include "masks/Silhouette.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace novelview
{
/** Which calibration of a folder to read, and how to interpret it. */
struct DatasetSource
{
  std::filesystem::path Calibration = {}; ///< file, or folder of a COLMAP model; empty = found
  std::string Format = "auto";            ///< a name of DatasetFormats.h; "auto" = found
  CameraConvention Convention = {};       ///< overrides the format's own
  /** Orientation tags of photographs: "ignore", "apply", or "auto" (see ExifDecision.h). */
  std::string ExifOrientation = "auto";
  std::optional<double> WhiteLevel = {}; ///< of photographs with more than 8 bits; else the file's
};

/** A data set before any image is decoded. Cameras are in the project's convention. */
struct DatasetIndex
{
  std::filesystem::path Folder;
  std::filesystem::path Calibration; ///< the file that was read
  std::string Format;                ///< its format
  DatasetSource Source;              ///< how it was to be read
  std::vector<Photograph> Cameras;   ///< with distinct names
  std::vector<ReadingNote> Notes;    ///< what was ignored, guessed or changed
  int MaxSize = 0;                   ///< longer side to which photographs are reduced; 0 = none is
};

/**
 * Finds and reads the calibration of a folder. Errors: no such folder; no calibration found, or
 * several and none chosen (both say what was looked for); whatever the format's reader throws; a
 * camera that is none in the convention used.
 */
DatasetIndex ReadDatasetIndex(
  const std::filesystem::path& folder, const DatasetSource& source = {});

/**
 * The cameras of a calibration file of any format, for novel views; File of each is where its
 * image would lie. Errors as ReadDatasetIndex(), but a calibration without photographs is no
 * error.
 */
std::vector<Photograph> ReadViewCameras(const std::filesystem::path& calibration);

struct DatasetOptions
{
  std::vector<std::string> Exclude; ///< photographs to leave out; they are not even opened
  bool ForceSilhouettes = false;    ///< extract silhouettes although there are masks
  SilhouetteOptions Silhouette;     ///< how, where there is no mask
};

struct Dataset
{
  vtkSmartPointer<vtkMultiBlockDataSet> Views; ///< see ViewAccess.h, with ContourDistance
  std::vector<Coverage> Coverages;             ///< of the silhouettes, per view
  std::vector<std::string> Warnings;           ///< one sentence each
};

/**
 * Reads the photographs and masks, each once and in parallel (see LimitThreads()), undistorts them,
 * extracts the silhouettes that are missing, and computes the distances to their contours. Errors:
 * a photograph or mask unreadable, a mask unlike its photograph in size, a photograph unlike its
 * calibration in size, photographs of one K but several sizes, a silhouette empty or full, a name
 * to exclude unknown, no photograph left.
 * @param progress receives the fraction of photographs read, in any thread.
 */
Dataset ReadDataset(const DatasetIndex& index, const DatasetOptions& options = {},
  const std::function<void(double fraction)>& progress = {});

/**
 * The photograph that goes by a name: its own, or as the calibration or the folder has it (images/a.png,
 * ./a.png, or a where only one photograph is a.png or a.jpg); null when there is none.
 */
const Photograph* PhotographOfName(
  const std::vector<Photograph>& photographs, const std::string& name);

/** The photographs that are not excluded. Errors as ReadDataset(). */
std::vector<Photograph> WithoutExcluded(
  const DatasetIndex& index, const std::vector<std::string>& exclude);

/** Where a silhouette came from. */
enum class MaskSource
{
  File,
  Alpha,
  Extracted
};

/** The pixels of a photograph as a pinhole would have taken them. */
struct PhotographPixels
{
  Image<std::uint8_t> Color; ///< RGB
  Image<std::uint8_t> Mask;  ///< above 127 = object; also 0 where undistorting exposes the border
  MaskSource Source = MaskSource::File;
  std::vector<std::string> Warnings; ///< about its tones
};

/**
 * Decodes a photograph and its mask: file, else alpha channel (unless that is opaque throughout),
 * else extracted from the photograph; inverted if requested; undistorted. Errors as ReadDataset().
 */
PhotographPixels ReadPhotograph(
  const Photograph& photograph, bool forceSilhouette, const SilhouetteOptions& silhouette);

/** The mask that a photograph comes with, from its file or alpha channel, inverted if requested and
 * not undistorted; empty when it has none. */
Image<std::uint8_t> ReadGivenMask(const Photograph& photograph);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/** The formats that calibrations of data sets come in, as one table. */
#ifndef novelview_DatasetFormats_h
#define novelview_DatasetFormats_h

#include "cameras/CameraConvention.h"
#include "cameras/Photograph.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace novelview
{
/** What a calibration file states, before any convention is applied. */
struct Calibration
{
  CameraConvention Convention;         ///< the one the cameras are stated in, complete
  std::vector<Photograph> Photographs; ///< File is set, Mask only where the calibration names one
  std::vector<ReadingNote> Notes = {}; ///< what was ignored or guessed
};

/** A file to be written. */
struct FileContent
{
  std::filesystem::path Path; ///< in the data set's folder
  std::string Bytes;
};

/** A format of data sets; what is done with one. */
struct DatasetFormat
{
  std::string Name;      ///< "colmap"
  std::string LookedFor; ///< the file that identifies the format, for messages

  /** The calibrations of this format that a folder contains. */
  std::function<std::vector<std::filesystem::path>(const std::filesystem::path& folder)> Find;

  /** Whether a path given by the user looks like a calibration of this format. */
  std::function<bool(const std::filesystem::path& calibration)> Accepts;

  /** Reads one; `folder` is that of the data set. */
  std::function<Calibration(
    const std::filesystem::path& folder, const std::filesystem::path& calibration)>
    Read;

  // ---- writing
  std::string PhotoFolder; ///< where photographs go, in the data set's folder; empty = there
  std::string MaskFolder;  ///< where masks go
  /** The name of a photograph's mask in there. */
  std::function<std::string(const std::string& name)> MaskName;
  /** Whether the format has numbers for the lens of a photograph. */
  std::function<bool(const Photograph& photograph)> HoldsLens;
  /**
   * The files of a calibration, to be written in this order: the last one is what makes the folder
   * a data set. Photographs have names, sizes and cameras in the project's convention; where Mask
   * is set it is a path in the data set's folder. `name` is for formats that leave the file's name
   * to the writer. Throws Error when the format cannot represent a camera. None where a format is
   * only read.
   */
  std::function<std::vector<FileContent>(
    const std::string& name, const std::vector<Photograph>& photographs)>
    Compose;
};

/** All formats, in the order in which they are tried. */
const std::vector<DatasetFormat>& DatasetFormats();

/** Their names. */
std::vector<std::string> DatasetFormatNames();

/** The names of those that can be written. */
std::vector<std::string> WritableFormatNames();

/** A format by its name; throws Error when there is none. */
const DatasetFormat& FormatOf(const std::string& name);

/** A calibration in a folder. */
struct FoundCalibration
{
  const DatasetFormat* Format = nullptr;
  std::filesystem::path File;
};

/** Every calibration of the format (or, with "auto", of any) that the folder contains. */
std::vector<FoundCalibration> CalibrationsIn(
  const std::filesystem::path& folder, const std::string& format = "auto");

/**
 * The calibration to read. With a path given, "auto" detects the format of the file. Throws Error
 * when there is none or more than one.
 */
FoundCalibration ChooseCalibration(const std::filesystem::path& folder,
  const std::filesystem::path& calibration, const std::string& format);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Data sets in the Middlebury multi-view layout: a folder with photographs and one calibration file
 *
 *     NAME_par.txt    number of photographs, then one line each
 *                     file k11 k12 k13 k21 .. k33 r11 .. r33 t1 t2 t3
 *     mask/FILE       optional silhouettes, above 127 = object; mask/STEM.png will do as well
 *
 * with x_cam = R x_world + t, u ~ K x_cam and pixel centres on integers, which is the project's own
 * convention. Line ends may be LF or CRLF.
 *
 * Errors are novelview::Error, naming file and line or photograph.
 */
#ifndef novelview_Middlebury_h
#define novelview_Middlebury_h

#include "Camera.h"
#include "Silhouette.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** A line of a calibration file. The camera's image size is 0x0: the file does not say it. */
struct NamedCamera
{
  std::string Name;
  Camera Cam;
};

/**
 * Reads a calibration file. Errors: file missing, first line no count, count unlike the number of
 * lines, line short or long, a number malformed, a name twice, K singular, R no rotation.
 */
std::vector<NamedCamera> ReadCameras(const std::filesystem::path& parFile);

/** Writes a calibration file; every number reads back as the same bits. */
void WriteCameras(const std::filesystem::path& parFile, const std::vector<NamedCamera>& cameras);

/** The names of a folder's calibration files, *_par.txt, sorted. */
std::vector<std::string> ParFilesIn(const std::filesystem::path& folder);

/** A data set before any picture is decoded. */
struct DatasetIndex
{
  std::filesystem::path Folder;
  std::filesystem::path ParFile;
  std::vector<NamedCamera> Cameras;
};

/**
 * Finds and reads the calibration of a folder. `parFile` chooses one; without it there must be
 * exactly one *_par.txt.
 */
DatasetIndex ReadDatasetIndex(
  const std::filesystem::path& folder, const std::filesystem::path& parFile = {});

struct DatasetOptions
{
  std::vector<std::string> Exclude; ///< photographs to leave out; they are not even opened
  bool ForceSilhouettes = false;    ///< extract silhouettes although there are masks
  SilhouetteOptions Silhouette;     ///< how, where there is no mask
};

struct Dataset
{
  vtkSmartPointer<vtkMultiBlockDataSet> Views; ///< as ViewAccess.h says, with ContourDistance
  std::vector<Coverage> Coverages;             ///< of the silhouettes, per view
  std::vector<std::string> Warnings;           ///< one sentence each
};

/**
 * Reads the photographs and masks, each once and in parallel (see LimitThreads()), extracts the
 * silhouettes that are missing, and computes the distances to their contours. Errors: a photograph
 * or mask unreadable, a mask unlike its photograph in size, photographs of one K but several sizes, a silhouette empty or full, a name to
 * exclude unknown, no photograph left.
 */
Dataset ReadDataset(const DatasetIndex& index, const DatasetOptions& options = {});

/** The mask file of a photograph of this folder; empty when there is none. */
std::filesystem::path MaskFileOf(const std::filesystem::path& folder, const std::string& name);

/** Writes views as a data set: folder/FILE, folder/mask/FILE and folder/`name`_par.txt. */
void WriteDataset(
  vtkMultiBlockDataSet* views, const std::filesystem::path& folder, const std::string& name);
}

#endif

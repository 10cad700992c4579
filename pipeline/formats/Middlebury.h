// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Calibrations in the Middlebury multi-view layout: a folder with photographs and one file
 *
 *     NAME_par.txt    number of photographs, then one line each
 *                     file k11 k12 k13 k21 .. k33 r11 .. r33 t1 t2 t3
 *
 * with x_cam = R x_world + t, u ~ K x_cam and pixel centres on integers, which is the project's own
 * convention. Line ends may be LF or CRLF. A file name is a path in the folder, without blanks.
 *
 * Errors are novelview::Error, naming file and line.
 */
#ifndef novelview_Middlebury_h
#define novelview_Middlebury_h

#include "formats/DatasetFormats.h"

#include <vtkMultiBlockDataSet.h>

#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/**
 * Reads a calibration file. Errors: file missing, first line no count, count unlike the number of
 * lines, line short or long, a number malformed, a name twice, K singular, R no rotation.
 */
std::vector<NamedCamera> ReadCameras(const std::filesystem::path& parFile);

/** Writes a calibration file; every number reads back as the same bits. */
void WriteCameras(const std::filesystem::path& parFile, const std::vector<NamedCamera>& cameras);

/** The names of a folder's calibration files, *_par.txt, sorted. */
std::vector<std::string> ParFilesIn(const std::filesystem::path& folder);

/** Writes views as a data set: folder/FILE, folder/mask/FILE and folder/`name`_par.txt. */
void WriteDataset(
  vtkMultiBlockDataSet* views, const std::filesystem::path& folder, const std::string& name);

DatasetFormat MiddleburyFormat();
}

#endif

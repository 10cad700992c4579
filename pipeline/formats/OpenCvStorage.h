// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Reading what OpenCV's cv::FileStorage writes: YAML (with its own header, "%YAML:1.0"), XML and
 * JSON. OpenCV's reader is not used, since it crashes on damaged files.
 *
 * Not read: base64 data, anchors and aliases of YAML, more than the first document of a file.
 */
#ifndef novelview_OpenCvStorage_h
#define novelview_OpenCvStorage_h

#include "formats/StorageNode.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace novelview
{
/** Larger files are no calibrations; the values of a file take several times its size. */
constexpr std::size_t MaxStorageBytes = 32 << 20;

/** The root of a file. Throws Error, naming file and line. */
StorageNode ReadOpenCvStorage(const std::filesystem::path& file);

/** The same from a text, which is YAML, XML or JSON as its first sign states. */
StorageNode ParseOpenCvStorage(const std::string& text, const std::string& where);
}

#endif

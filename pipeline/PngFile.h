// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_PngFile_h
#define novelview_PngFile_h

#include "ImageRef.h"

#include <cstdint>
#include <filesystem>

class vtkImageData;

namespace novelview
{
/** Writes grey (1 channel) or RGB (3) pixels as a PNG file, atomically. Throws Error. */
void WritePng(const std::filesystem::path& path, const ImageRef<const std::uint8_t>& image);

/** The array "Color" (RGB) of a VTK image. */
void WritePng(const std::filesystem::path& path, vtkImageData* image);
}

#endif

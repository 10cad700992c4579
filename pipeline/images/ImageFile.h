// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * Images in files, to and from pixels with rows from the top and channels in the order RGB. The
 * format follows the extension: PNG, JPEG, TIFF, BMP, PPM and whatever else OpenCV was built with.
 *
 * Every function throws Error, naming the file. Writing goes through WriteAtomically, so folders
 * are made and a failed write leaves nothing behind.
 */
#ifndef novelview_ImageFile_h
#define novelview_ImageFile_h

#include "core/ImageRef.h"

#include <vtkSmartPointer.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

class vtkImageData;

namespace novelview
{
/** OpenCV prints about files that it cannot read; here the Error states so. */
void SilenceOpenCv();

/** How the colours of a file are read. */
struct ColorReading
{
  int Orientation = 1; ///< the pixels, which are as stored, are turned by it, see ExifOrientation.h
  double WhiteLevel = 0; ///< of files with more than 8 bits per value; 0 = as the file says
};

/**
 * Three channels of 8 bits, RGB. White is 255 in files of 8 bits, 65535 in those of 16 (or what a
 * PNG's count of significant bits says, if no value is above), 1 in those of floats, or 255 where
 * values are above 2. `warnings` takes a sentence when the values do not look like that.
 */
Image<std::uint8_t> ReadColorFile(const std::filesystem::path& path,
  const ColorReading& reading = {}, std::vector<std::string>* warnings = nullptr);

/** One channel of 8 bits, e.g. a mask. */
Image<std::uint8_t> ReadGreyFile(const std::filesystem::path& path);

/** The alpha channel, 8 bits, turned likewise; empty when the file has none or all of it is opaque. */
Image<std::uint8_t> ReadAlphaFile(const std::filesystem::path& path, int orientation = 1);

/** One channel of floats, e.g. a depth image in world units, from a 32-bit float TIFF. */
Image<float> ReadFloatFile(const std::filesystem::path& path);

/** One (grey) or three (RGB) channels. */
void WriteImageFile(const std::filesystem::path& path, const ImageRef<const std::uint8_t>& pixels);

/** The bytes of a JPEG file of one (grey) or three (RGB) channels; quality 0 to 100. Errors name
 * `where`. */
std::vector<std::uint8_t> EncodeJpeg(
  const ImageRef<const std::uint8_t>& pixels, int quality, const std::string& where);

/** The bytes of a PNG file of one (grey) or three (RGB) channels. Errors name `where`. */
std::vector<std::uint8_t> EncodePng(
  const ImageRef<const std::uint8_t>& pixels, const std::string& where);

/** One channel, as a 32-bit float TIFF; the extension must be .tif or .tiff. */
void WriteFloatFile(const std::filesystem::path& path, const ImageRef<const float>& pixels);

/** The image made smaller, each pixel the mean of its area; empty when it is. */
Image<std::uint8_t> ReducedImage(const ImageRef<const std::uint8_t>& pixels, int width, int height);

/** Width and height of an image; of PNG and JPEG files from the header alone. */
struct PictureSize
{
  int Width = 0;
  int Height = 0;
};
PictureSize ReadPictureSize(const std::filesystem::path& path);

/** Adds (or replaces) a point array of an image block; the sizes must agree. */
void SetPixels(vtkImageData* image, const char* array, const ImageRef<const std::uint8_t>& pixels);
void SetPixels(vtkImageData* image, const char* array, const ImageRef<const float>& pixels);

/** An image as an image block with the point array Color. */
vtkSmartPointer<vtkImageData> ReadColorImage(const std::filesystem::path& path);

/** Writes a point array of an image block: uint8 x 1, uint8 x 3, or (as TIFF) float x 1. */
void WriteArray(const std::filesystem::path& path, vtkImageData* image, const char* array);
}

#endif

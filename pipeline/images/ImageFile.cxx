// SPDX-License-Identifier: GPL-3.0-or-later
#include "images/ImageFile.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "base/StderrSilence.h"
#include "core/Error.h"
#include "images/DecodedPicture.h"
#include "images/OpenCvPixels.h"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <limits>
#include <mutex>
#include <string>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/**
 * Whether the bytes of a JPEG file lack the end of the picture. OpenCV fills what is missing with
 * grey without an error. Within the image's data no marker can appear by chance, so after its
 * start (FF DA) there is an end (FF D9), or the file is cut.
 */
bool IsTruncatedJpeg(const std::string& bytes)
{
  if (bytes.rfind("\xff\xd8", 0) != 0)
  {
    return false;
  }
  const std::size_t start = bytes.rfind("\xff\xda");
  return start == std::string::npos || bytes.find("\xff\xd9", start) == std::string::npos;
}

void Encode(const fs::path& path, const cv::Mat& mat)
{
  SilenceOpenCv();
  std::vector<std::uint8_t> bytes;
  try
  {
    const StderrSilence silence;
    if (!cv::imencode(path.extension().string(), mat, bytes))
    {
      bytes.clear();
    }
  }
  catch (const cv::Exception&)
  {
    bytes.clear();
  }
  if (bytes.empty())
  {
    throw Error(path.string(), "cannot be written as a picture", path.extension().string(),
      "an extension of a picture, as .png");
  }
  WriteTextAtomically(path, { reinterpret_cast<const char*>(bytes.data()), bytes.size() });
}

/**
 * Whether a file can have an alpha channel, as far as that can be determined quickly: JPEG, BMP and
 * similar formats never have one, and a PNG's header states it.
 */
bool MayHaveAlpha(const fs::path& path)
{
  constexpr std::size_t headBytes = 4096; // with the palette
  const std::string head = ReadInputStart(path, headBytes);
  if (head.size() >= 26 && head.compare(1, 5, "PNG\r\n") == 0)
  {
    // Colour type: 4 = grey and alpha, 6 = colour and alpha; others have a chunk of transparency.
    return (head[25] & 4) || head.find("tRNS") != std::string::npos;
  }
  const std::string extension = path.extension().string();
  return extension == ".tif" || extension == ".tiff" || extension == ".webp";
}

bool IsTiff(const fs::path& path)
{
  return path.extension() == ".tif" || path.extension() == ".tiff";
}

template <class T>
void CopyRows(const ImageRef<const T>& from, const ImageRef<T>& to)
{
  for (int y = 0; y < from.Height; ++y)
  {
    const T* row = from.Row(y);
    std::copy(row, row + static_cast<std::ptrdiff_t>(from.Width) * from.Channels, to.Row(y));
  }
}

template <class T>
void SetPixelsOf(vtkImageData* image, const char* array, const ImageRef<const T>& pixels)
{
  int size[3];
  image->GetDimensions(size);
  if (size[0] != pixels.Width || size[1] != pixels.Height)
  {
    throw Error(std::string("array ") + array, "pixels have the wrong size",
      SizeText(pixels.Width, pixels.Height), SizeText(size[0], size[1]));
  }
  CopyRows(pixels, AddTopDownArray<T>(image, array, pixels.Channels));
}
}

cv::Mat DecodePicture(const fs::path& path, int flags)
{
  SilenceOpenCv();
  std::string bytes = ReadInputFile(path);
  constexpr std::size_t most = std::numeric_limits<int>::max(); // OpenCV counts in int
  cv::Mat mat;
  if (!bytes.empty() && bytes.size() <= most)
  {
    try
    {
      const StderrSilence silence;
      mat = cv::imdecode(cv::Mat(1, static_cast<int>(bytes.size()), CV_8UC1, bytes.data()), flags);
    }
    catch (const cv::Exception&)
    {
      mat.release(); // the message would be about OpenCV's source code
    }
  }
  if (mat.empty() || IsTruncatedJpeg(bytes))
  {
    throw Error(path.string(), "cannot be read as a picture",
      bytes.empty() ? "an empty file" : std::to_string(bytes.size()) + " bytes",
      "a whole PNG, JPEG, TIFF or other picture");
  }
  return mat;
}

cv::Mat TurnedPicture(cv::Mat mat, int orientation)
{
  if (orientation >= 5)
  {
    cv::transpose(mat, mat);
  }
  const bool horizontally =
    orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7;
  const bool vertically =
    orientation == 3 || orientation == 4 || orientation == 7 || orientation == 8;
  if (horizontally || vertically)
  {
    cv::flip(mat, mat, horizontally && vertically ? -1 : (horizontally ? 1 : 0));
  }
  return mat;
}

void SilenceOpenCv()
{
  static std::once_flag once;
  std::call_once(
    once, [] { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); });
}

Image<std::uint8_t> ReadGreyFile(const fs::path& path)
{
  return FromMat<std::uint8_t>(
    DecodePicture(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION));
}

Image<std::uint8_t> ReadAlphaFile(const fs::path& path, int orientation)
{
  if (!MayHaveAlpha(path))
  {
    return {};
  }
  const cv::Mat mat = DecodePicture(path, cv::IMREAD_UNCHANGED);
  if (mat.channels() != 4)
  {
    return {};
  }
  cv::Mat alpha;
  cv::extractChannel(mat, alpha, 3);
  // Bits of other depths are brought to eight.
  alpha.convertTo(alpha, CV_8U, mat.depth() == CV_16U ? 1.0 / 257 : 1.0);
  double least = 0;
  cv::minMaxLoc(alpha, &least);
  return least == 255 ? Image<std::uint8_t>()
                      : FromMat<std::uint8_t>(TurnedPicture(alpha, orientation));
}

Image<float> ReadFloatFile(const fs::path& path)
{
  const cv::Mat mat = DecodePicture(path, cv::IMREAD_UNCHANGED);
  if (mat.type() != CV_32FC1)
  {
    throw Error(path.string(), "is not a depth image", cv::typeToString(mat.type()),
      "one channel of 32-bit floats");
  }
  return FromMat<float>(mat);
}

void WriteImageFile(const fs::path& path, const ImageRef<const std::uint8_t>& pixels)
{
  Encode(path, ToBgr(pixels));
}

std::vector<std::uint8_t> EncodeJpeg(
  const ImageRef<const std::uint8_t>& pixels, int quality, const std::string& where)
{
  std::vector<std::uint8_t> jpeg;
  if (!cv::imencode(".jpg", ToBgr(pixels), jpeg, { cv::IMWRITE_JPEG_QUALITY, quality }))
  {
    throw Error(where, "cannot be encoded as JPEG");
  }
  return jpeg;
}

std::vector<std::uint8_t> EncodePng(
  const ImageRef<const std::uint8_t>& pixels, const std::string& where)
{
  std::vector<std::uint8_t> png;
  if (!cv::imencode(".png", ToBgr(pixels), png))
  {
    throw Error(where, "cannot be encoded as PNG");
  }
  return png;
}

void WriteFloatFile(const fs::path& path, const ImageRef<const float>& pixels)
{
  if (!IsTiff(path))
  {
    throw Error(path.string(), "wrong format for floats", path.extension().string(), ".tif");
  }
  Encode(path, ToMat(pixels));
}

Image<std::uint8_t> ReducedImage(const ImageRef<const std::uint8_t>& pixels, int width, int height)
{
  if (pixels.Empty())
  {
    return {};
  }
  cv::Mat reduced;
  cv::resize(ToMat(pixels), reduced, cv::Size(width, height), 0, 0, cv::INTER_AREA);
  return FromMat<std::uint8_t>(reduced);
}

void SetPixels(vtkImageData* image, const char* array, const ImageRef<const std::uint8_t>& pixels)
{
  SetPixelsOf(image, array, pixels);
}

void SetPixels(vtkImageData* image, const char* array, const ImageRef<const float>& pixels)
{
  SetPixelsOf(image, array, pixels);
}

vtkSmartPointer<vtkImageData> ReadColorImage(const fs::path& path)
{
  const Image<std::uint8_t> pixels = ReadColorFile(path);
  vtkSmartPointer<vtkImageData> image = NewImage(pixels.Width, pixels.Height);
  SetPixels(image, arrays::Color, pixels.Ref());
  return image;
}

void WriteArray(const fs::path& path, vtkImageData* image, const char* array)
{
  vtkDataArray* values = image->GetPointData()->GetArray(array);
  const int channels = values ? values->GetNumberOfComponents() : 1;
  if (values && values->GetDataType() == VTK_FLOAT)
  {
    WriteFloatFile(path, TopDownArray<const float>(image, array, 1, path.string(), true));
    return;
  }
  WriteImageFile(path,
    TopDownArray<const unsigned char>(image, array, channels == 3 ? 3 : 1, path.string(), true));
}
}

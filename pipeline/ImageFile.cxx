// SPDX-License-Identifier: GPL-3.0-or-later
#include "ImageFile.h"

#include "AtomicFile.h"
#include "Error.h"
#include "OpenCvPixels.h"
#include "StderrSilence.h"
#include "ViewAccess.h"

#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>

#include <array>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
/**
 * Whether a JPEG file lacks the end of its picture. OpenCV fills what is missing with grey and says
 * nothing. Within the picture's data no marker can appear by chance, so after its start (FF DA)
 * there is an end (FF D9), or the file is cut.
 */
bool IsTruncatedJpeg(const fs::path& path)
{
  std::ifstream file(path, std::ios::binary);
  if (file.get() != 0xff || file.get() != 0xd8)
  {
    return false;
  }
  const std::string rest((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const std::size_t start = rest.rfind("\xff\xda");
  return start == std::string::npos || rest.find("\xff\xd9", start) == std::string::npos;
}

cv::Mat Decode(const fs::path& path, int flags)
{
  SilenceOpenCv();
  std::error_code failure;
  if (!fs::exists(path, failure))
  {
    throw Error(path.string(), "no such file");
  }
  cv::Mat mat;
  try
  {
    const StderrSilence silence;
    mat = cv::imread(path.string(), flags);
  }
  catch (const cv::Exception& error)
  {
    throw Error(path.string(), "cannot be read as a picture: " + error.err);
  }
  if (mat.empty() || IsTruncatedJpeg(path))
  {
    throw Error(path.string(), "cannot be read as a picture");
  }
  return mat;
}

void Encode(const fs::path& path, const cv::Mat& mat)
{
  SilenceOpenCv();
  WriteAtomically(path,
    [&](const fs::path& temporary)
    {
      try
      {
        return cv::imwrite(temporary.string(), mat);
      }
      catch (const cv::Exception& error)
      {
        throw Error(path.string(), "cannot be written as a picture: " + error.err);
      }
    });
}

/**
 * Whether a file can have an alpha channel, as far as that is quickly told: JPEG, BMP and the like
 * never have one, and a PNG's header says it.
 */
bool MayHaveAlpha(const fs::path& path)
{
  std::array<unsigned char, 26> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(head.data()), head.size());
  if (file && std::memcmp(head.data() + 1, "PNG\r\n", 5) == 0)
  {
    return head[25] & 4; // colour type: 4 = grey and alpha, 6 = colour and alpha
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

void SilenceOpenCv()
{
  static std::once_flag once;
  std::call_once(
    once, [] { cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT); });
}

Image<std::uint8_t> ReadColorFile(const fs::path& path)
{
  cv::Mat mat = Decode(path, cv::IMREAD_COLOR | cv::IMREAD_IGNORE_ORIENTATION);
  cv::cvtColor(mat, mat, cv::COLOR_BGR2RGB);
  return FromMat<std::uint8_t>(mat);
}

Image<std::uint8_t> ReadGreyFile(const fs::path& path)
{
  return FromMat<std::uint8_t>(Decode(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION));
}

Image<std::uint8_t> ReadAlphaFile(const fs::path& path)
{
  if (!MayHaveAlpha(path))
  {
    return {};
  }
  const cv::Mat mat = Decode(path, cv::IMREAD_UNCHANGED);
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
  return least == 255 ? Image<std::uint8_t>() : FromMat<std::uint8_t>(alpha);
}

Image<float> ReadFloatFile(const fs::path& path)
{
  const cv::Mat mat = Decode(path, cv::IMREAD_UNCHANGED);
  if (mat.type() != CV_32FC1)
  {
    throw Error(path.string(), "is no depth image", cv::typeToString(mat.type()),
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

void WriteFloatFile(const fs::path& path, const ImageRef<const float>& pixels)
{
  if (!IsTiff(path))
  {
    throw Error(path.string(), "wrong format for floats", path.extension().string(), ".tif");
  }
  Encode(path, ToMat(pixels));
}

PictureSize ReadPictureSize(const fs::path& path)
{
  // A PNG file: 8 bytes of signature, the length and name of the first chunk, then the size.
  std::array<unsigned char, 24> head{};
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(head.data()), head.size());
  if (file && std::memcmp(head.data() + 1, "PNG\r\n", 5) == 0)
  {
    const auto number = [&head](int at)
    { return head[at] << 24 | head[at + 1] << 16 | head[at + 2] << 8 | head[at + 3]; };
    return { number(16), number(20) };
  }
  const cv::Mat mat = Decode(path, cv::IMREAD_GRAYSCALE | cv::IMREAD_IGNORE_ORIENTATION);
  return { mat.cols, mat.rows };
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

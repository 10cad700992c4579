// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/InputFile.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "images/DecodedPicture.h"
#include "images/ImageFile.h"
#include "images/OpenCvPixels.h"

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include <string>
#include <vector>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr double White16 = 65535;
/** Sixteen bits that use so little of their range hold fewer bits. */
constexpr double DarkestWhite16 = 4095;

/** The largest value of the significant bits that a PNG's chunk counts; 0 when it has none. */
double SignificantWhite(const fs::path& path)
{
  constexpr std::size_t headBytes = 4096;
  const std::string head = ReadInputStart(path, headBytes);
  const std::size_t chunk = head.find("sBIT");
  if (!head.starts_with("\x89PNG") || chunk == std::string::npos || chunk + 4 >= head.size())
  {
    return 0;
  }
  const int bits = static_cast<unsigned char>(head[chunk + 4]);
  return bits > 8 && bits < 16 ? (1 << bits) - 1 : 0;
}

/** The value that is white; warns of what is guessed. */
double WhiteOf(const fs::path& path, const cv::Mat& mat, const std::string& wayOut,
  std::vector<std::string>& warnings)
{
  double largest = 0;
  cv::minMaxLoc(mat.reshape(1), nullptr, &largest);
  if (mat.depth() == CV_16U)
  {
    const double significant = SignificantWhite(path);
    if (significant > 0 && largest <= significant)
    {
      return significant;
    }
    if (largest > 0 && largest <= DarkestWhite16)
    {
      warnings.push_back("values of 16 bits, the largest is " + NumberText(largest) +
        " of 65535: nearly black; " + wayOut);
    }
    return White16;
  }
  constexpr double highlights = 2; // of values that are meant to end at 1
  if (largest > 255)
  {
    throw Error(path.string(), "floats in no range that is known",
      "values up to " + NumberText(largest), "0 to 1 or 0 to 255; " + wayOut);
  }
  if (largest > 1 && largest <= highlights)
  {
    warnings.push_back(
      "floats up to " + NumberText(largest) + ": what is above 1 is cut off; " + wayOut);
  }
  return largest <= highlights ? 1 : 255;
}

/** Brings values of any depth to 8 bits. */
cv::Mat ToEightBits(
  const fs::path& path, const cv::Mat& mat, double whiteLevel, std::vector<std::string>& warnings)
{
  if (mat.depth() == CV_8U)
  {
    return mat;
  }
  const double white = whiteLevel > 0
    ? whiteLevel
    : WhiteOf(path, mat, "--white-level says which value is white", warnings);
  cv::Mat result;
  if (mat.depth() == CV_16U && white == White16)
  {
    // The upper eight bits: v / 256, rounded down.
    mat.convertTo(result, CV_8U, 1.0 / 256, -0.5 + 1.0 / 512);
    return result;
  }
  mat.convertTo(result, CV_8U, 255 / white);
  return result;
}
}

Image<std::uint8_t> ReadColorFile(
  const fs::path& path, const ColorReading& reading, std::vector<std::string>* warnings)
{
  std::vector<std::string> unheard;
  cv::Mat mat =
    DecodePicture(path, cv::IMREAD_COLOR | cv::IMREAD_ANYDEPTH | cv::IMREAD_IGNORE_ORIENTATION);
  mat = ToEightBits(path, mat, reading.WhiteLevel, warnings ? *warnings : unheard);
  cv::cvtColor(mat, mat, cv::COLOR_BGR2RGB);
  return FromMat<std::uint8_t>(TurnedPicture(mat, reading.Orientation));
}
}

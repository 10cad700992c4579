// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/ColmapText.h"

#include "base/InputFile.h"
#include "base/NumberText.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"

#include <sstream>

namespace novelview
{
namespace fs = std::filesystem;
namespace
{
constexpr std::size_t NumbersBeforeName = 9;

/** The lines of a file with their places. */
class LineReader
{
public:
  explicit LineReader(const fs::path& path)
    : Path(path)
    , File(ReadInputText(path))
  {
  }

  /** The next line whatever it contains; false at the end. */
  bool Next(std::string& line)
  {
    if (!std::getline(this->File, line))
    {
      return false;
    }
    ++this->Number;
    while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
    {
      line.pop_back();
    }
    return true;
  }

  /** The next line that is neither empty nor a comment. */
  bool NextData(std::string& line)
  {
    while (this->Next(line))
    {
      const std::size_t first = line.find_first_not_of(" \t");
      if (first != std::string::npos && line[first] != '#')
      {
        return true;
      }
    }
    return false;
  }

  std::string Where() const
  {
    return this->Path.string() + ", line " + std::to_string(this->Number);
  }

private:
  fs::path Path;
  std::istringstream File;
  int Number = 0;
};

template <class T>
T Parsed(const std::string& word, const std::string& where, const char* what)
{
  T number{};
  if (!ParseNumber(word, number))
  {
    throw Error(where, std::string(what) + " is not a number", "'" + word + "'", "a number");
  }
  return number;
}

std::vector<ColmapCamera> ReadCameraLines(const fs::path& path)
{
  LineReader lines(path);
  std::vector<ColmapCamera> cameras;
  for (std::string line; lines.NextData(line);)
  {
    const std::vector<std::string> words = Words(line);
    ColmapCamera camera;
    camera.Where = lines.Where();
    if (words.size() < 5)
    {
      throw Error(camera.Where, "camera line is short", std::to_string(words.size()) + " words",
        "CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]");
    }
    camera.Id = Parsed<std::uint32_t>(words[0], camera.Where, "camera id");
    camera.Model = words[1];
    camera.Width = Parsed<int>(words[2], camera.Where, "width");
    camera.Height = Parsed<int>(words[3], camera.Where, "height");
    for (std::size_t i = 4; i < words.size(); ++i)
    {
      camera.Parameters.push_back(Parsed<double>(words[i], camera.Where, "camera parameter"));
    }
    cameras.push_back(camera);
  }
  return cameras;
}

/** The name is the rest of the line after nine numbers; it may contain blanks. */
std::string NameIn(const std::string& line)
{
  std::size_t at = 0;
  for (std::size_t i = 0; i < NumbersBeforeName; ++i)
  {
    at = line.find_first_of(" \t", line.find_first_not_of(" \t", at));
  }
  return line.substr(line.find_first_not_of(" \t", at));
}

/** x y id, any number of times: an image line in its place would be left out unnoticed. */
void CheckPointsLine(const std::string& line, const std::string& where)
{
  const std::vector<std::string> words = Words(line);
  double number = 0;
  if (words.size() % 3 != 0 || (!words.empty() && !ParseNumber(words.back(), number)))
  {
    throw Error(
      where, "is not a line of points; every image has two lines, the second may be empty");
  }
}

std::vector<ColmapImage> ReadImageLines(const fs::path& path)
{
  LineReader lines(path);
  std::vector<ColmapImage> images;
  for (std::string line; lines.NextData(line);)
  {
    const std::vector<std::string> words = Words(line);
    ColmapImage image;
    image.Where = lines.Where();
    if (words.size() <= NumbersBeforeName)
    {
      throw Error(image.Where, "image line is short", std::to_string(words.size()) + " words",
        "IMAGE_ID QW QX QY QZ TX TY TZ CAMERA_ID NAME");
    }
    image.Id = Parsed<std::uint32_t>(words[0], image.Where, "image id");
    for (std::size_t i = 0; i < 4; ++i)
    {
      image.Rotation[i] = Parsed<double>(words[1 + i], image.Where, "quaternion");
    }
    for (std::size_t i = 0; i < 3; ++i)
    {
      image.Translation[i] = Parsed<double>(words[5 + i], image.Where, "translation");
    }
    image.CameraId = Parsed<std::uint32_t>(words[8], image.Where, "camera id");
    image.Name = NameIn(line);
    images.push_back(image);
    if (lines.Next(line))
    {
      CheckPointsLine(line, lines.Where());
    }
  }
  return images;
}
}

ColmapModel ReadColmapText(const fs::path& folder)
{
  return { ReadCameraLines(FileOfAnyCase(folder / "cameras.txt")),
    ReadImageLines(FileOfAnyCase(folder / "images.txt")) };
}

std::vector<FileContent> ComposeColmapText(const ColmapModel& model)
{
  std::string cameras = "# Camera list with one line of data per camera:\n"
                        "#   CAMERA_ID, MODEL, WIDTH, HEIGHT, PARAMS[]\n"
                        "# Number of cameras: " +
    std::to_string(model.Cameras.size()) + "\n";
  for (const ColmapCamera& camera : model.Cameras)
  {
    cameras += std::to_string(camera.Id) + " " + camera.Model + " " + std::to_string(camera.Width) +
      " " + std::to_string(camera.Height);
    for (const double parameter : camera.Parameters)
    {
      cameras += " " + NumberText(parameter);
    }
    cameras += "\n";
  }
  std::string images = "# Image list with two lines of data per image:\n"
                       "#   IMAGE_ID, QW, QX, QY, QZ, TX, TY, TZ, CAMERA_ID, NAME\n"
                       "#   POINTS2D[] as (X, Y, POINT3D_ID)\n"
                       "# Number of images: " +
    std::to_string(model.Images.size()) + ", mean observations per image: 0\n";
  for (const ColmapImage& image : model.Images)
  {
    if (Words(image.Name) != std::vector{ image.Name })
    {
      throw Error("images.txt", "a file name with blanks cannot be written", "'" + image.Name + "'",
        "a name without blanks, or the format colmap-binary");
    }
    images += std::to_string(image.Id);
    for (const double number : image.Rotation)
    {
      images += " " + NumberText(number);
    }
    for (const double number : image.Translation)
    {
      images += " " + NumberText(number);
    }
    images += " " + std::to_string(image.CameraId) + " " + image.Name + "\n\n";
  }
  const char* const points =
    "# 3D point list with one line of data per point:\n"
    "#   POINT3D_ID, X, Y, Z, R, G, B, ERROR, TRACK[] as (IMAGE_ID, POINT2D_IDX)\n"
    "# Number of points: 0, mean track length: 0\n";
  return { { "points3D.txt", points }, { "cameras.txt", cameras }, { "images.txt", images } };
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/ColmapBinary.h"

#include "base/ByteStream.h"
#include "base/InputFile.h"
#include "cameras/CameraLimits.h"
#include "cameras/PhotographFiles.h"
#include "core/Error.h"

#include <bit>
#include <string>
#include <string_view>

namespace novelview
{
static_assert(std::endian::native == std::endian::little, "COLMAP's files are little-endian");

namespace fs = std::filesystem;
namespace
{
/** Numbers and texts of a file one after the other, with the place in errors; never reads behind the end. */
class ModelReader
{
public:
  explicit ModelReader(const fs::path& path)
    : Path(path.string())
    , Bytes(ReadInputFile(path))
    , Cursor(this->Bytes)
  {
  }
  ModelReader(const ModelReader&) = delete;
  ModelReader& operator=(const ModelReader&) = delete;

  template <class T>
  T Take()
  {
    return NumberFrom<T>(this->TakeBytes(1, sizeof(T)).data());
  }

  /** A text up to its zero. */
  std::string TakeText()
  {
    const std::size_t length = this->Cursor.Rest().find('\0');
    const std::string_view text =
      this->TakeBytes(length == std::string_view::npos ? this->Cursor.Left() + 1 : length + 1);
    return std::string(text.substr(0, length));
  }

  /** Passes over `count` things of `size` bytes. */
  void Skip(std::uint64_t count, std::size_t size) { this->TakeBytes(count, size); }

  /** The end must have been reached. */
  void Finish() const
  {
    if (this->Cursor.Left() > 0)
    {
      throw Error(this->Where(), "file continues after its end",
        std::to_string(this->Cursor.Left()) + " bytes more", "none");
    }
  }

  std::string Where() const
  {
    return this->Path + ", byte " + std::to_string(this->Cursor.Position());
  }

private:
  std::string_view TakeBytes(std::uint64_t count, std::size_t size = 1)
  {
    if (const auto taken = this->Cursor.Take(count, size))
    {
      return *taken;
    }
    throw Error(this->Where(), "file ends too early");
  }

  std::string Path;
  std::string Bytes;
  ByteCursor Cursor;
};

int TakeExtent(ModelReader& reader)
{
  const std::string where = reader.Where();
  const auto extent = reader.Take<std::uint64_t>();
  return ExtentOf(static_cast<double>(extent), "width or height", where);
}

std::vector<ColmapCamera> ReadCameraRecords(const fs::path& path)
{
  ModelReader reader(path);
  std::vector<ColmapCamera> cameras;
  const auto count = reader.Take<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    ColmapCamera camera;
    camera.Where = reader.Where();
    camera.Id = reader.Take<std::uint32_t>();
    const auto model = reader.Take<std::int32_t>();
    camera.Model = ColmapModelName(model);
    if (camera.Model.empty())
    {
      throw Error(camera.Where, "unknown camera model", std::to_string(model), "0 to 17");
    }
    camera.Width = TakeExtent(reader);
    camera.Height = TakeExtent(reader);
    for (int parameter = 0; parameter < ColmapParameterCount(camera.Model); ++parameter)
    {
      camera.Parameters.push_back(reader.Take<double>());
    }
    cameras.push_back(camera);
  }
  reader.Finish();
  return cameras;
}

std::vector<ColmapImage> ReadImageRecords(const fs::path& path)
{
  ModelReader reader(path);
  std::vector<ColmapImage> images;
  const auto count = reader.Take<std::uint64_t>();
  for (std::uint64_t i = 0; i < count; ++i)
  {
    ColmapImage image;
    image.Where = reader.Where();
    image.Id = reader.Take<std::uint32_t>();
    for (double& number : image.Rotation)
    {
      number = reader.Take<double>();
    }
    for (double& number : image.Translation)
    {
      number = reader.Take<double>();
    }
    image.CameraId = reader.Take<std::uint32_t>();
    image.Name = reader.TakeText();
    // Points: x, y and the number of a point in space.
    const auto points = reader.Take<std::uint64_t>();
    reader.Skip(points, 2 * sizeof(double) + sizeof(std::int64_t));
    images.push_back(image);
  }
  reader.Finish();
  return images;
}
}

ColmapModel ReadColmapBinary(const fs::path& folder)
{
  return { ReadCameraRecords(FileOfAnyCase(folder / "cameras.bin")),
    ReadImageRecords(FileOfAnyCase(folder / "images.bin")) };
}

std::vector<FileContent> ComposeColmapBinary(const ColmapModel& model)
{
  ByteWriter cameras;
  cameras.Add<std::uint64_t>(model.Cameras.size());
  for (const ColmapCamera& camera : model.Cameras)
  {
    cameras.Add<std::uint32_t>(camera.Id);
    cameras.Add<std::int32_t>(ColmapModelNumber(camera.Model));
    cameras.Add<std::uint64_t>(static_cast<std::uint64_t>(camera.Width));
    cameras.Add<std::uint64_t>(static_cast<std::uint64_t>(camera.Height));
    for (const double parameter : camera.Parameters)
    {
      cameras.Add<double>(parameter);
    }
  }
  ByteWriter images;
  images.Add<std::uint64_t>(model.Images.size());
  for (const ColmapImage& image : model.Images)
  {
    images.Add<std::uint32_t>(image.Id);
    for (const double number : image.Rotation)
    {
      images.Add<double>(number);
    }
    for (const double number : image.Translation)
    {
      images.Add<double>(number);
    }
    images.Add<std::uint32_t>(image.CameraId);
    images.AddBytes(image.Name.c_str(), image.Name.size() + 1); // with the zero at its end
    images.Add<std::uint64_t>(0);
  }
  ByteWriter points;
  points.Add<std::uint64_t>(0);
  return { { "points3D.bin", points.Written }, { "cameras.bin", cameras.Written },
    { "images.bin", images.Written } };
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "dataset/PhotographSize.h"

#include "base/NumberText.h"
#include "base/SystemMemory.h"
#include "cameras/CameraLimits.h"
#include "core/Error.h"
#include "images/ExifOrientation.h"
#include "images/ImageFile.h"

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr double GiB = 1 << 30;

int LongerSide(const Camera& camera)
{
  return std::max(camera.Width, camera.Height);
}

/** The largest longer side for which the photographs need no more than this. */
int SizeWithin(const std::vector<Camera>& cameras, double bytes)
{
  int longest = 0;
  for (const Camera& camera : cameras)
  {
    longest = std::max(longest, LongerSide(camera));
  }
  const auto fits = [&](int maxSize)
  {
    std::vector<Camera> reduced = cameras;
    for (Camera& camera : reduced)
    {
      const double scale = std::min(1.0, static_cast<double>(maxSize) / LongerSide(camera));
      camera.Width = static_cast<int>(std::lround(scale * camera.Width));
      camera.Height = static_cast<int>(std::lround(scale * camera.Height));
    }
    return MemoryFor(reduced) <= bytes;
  };
  constexpr int step = 16;
  constexpr int smallest = 320; // below, there is little left to see
  int size = longest;
  while (size > smallest && !fits(size))
  {
    size = (size - 1) / step * step;
  }
  return size;
}
}

Camera SizedCamera(const Photograph& photograph)
{
  Camera camera = photograph.Cam;
  if (camera.Width == 0)
  {
    const PictureSize size = ReadPictureSize(photograph.File);
    const bool turned = SwapsSides(photograph.Reading.Orientation);
    camera.Width = turned ? size.Height : size.Width;
    camera.Height = turned ? size.Width : size.Height;
  }
  return camera;
}

Camera InFrame(const Photograph& photograph, int width, int height, const std::string& with)
{
  constexpr double alike = 0.01; // cropping changes more, rounding of sizes less
  Camera camera = SizedCamera(photograph);
  const double x = static_cast<double>(width) / camera.Width;
  const double y = static_cast<double>(height) / camera.Height;
  if (std::abs(x - y) <= alike * std::max(x, y))
  {
    return Resized(camera, width, height);
  }
  if (camera.Width == height && camera.Height == width)
  {
    camera.K(0, 2) += (width - camera.Width) / 2.0;
    camera.K(1, 2) += (height - camera.Height) / 2.0;
  }
  else
  {
    throw Error("view " + photograph.Name,
      "has another shape than " + with + ", so their cameras cannot be averaged",
      SizeText(camera.Width, camera.Height),
      SizeText(width, height) + ", or a size that is scaled or turned from it");
  }
  camera.Width = width;
  camera.Height = height;
  return camera;
}

void RequireOneSizePerK(const std::vector<Photograph>& cameras)
{
  for (std::size_t i = 1; i < cameras.size(); ++i)
  {
    const Camera& camera = cameras[i].Cam;
    for (std::size_t j = 0; j < i; ++j)
    {
      const Camera& other = cameras[j].Cam;
      if (camera.K == other.K && (camera.Width != other.Width || camera.Height != other.Height))
      {
        throw Error("view " + cameras[i].Name,
          "photograph has another size than " + cameras[j].Name + ", whose K is the same",
          SizeText(camera.Width, camera.Height), SizeText(other.Width, other.Height));
      }
    }
  }
}

void Reduce(Photograph& photograph, int maxSize)
{
  const Camera camera = SizedCamera(photograph);
  const int longer = LongerSide(camera);
  if (maxSize <= 0 || longer <= maxSize)
  {
    return;
  }
  const double scale = static_cast<double>(maxSize) / longer;
  photograph.FileWidth = camera.Width;
  photograph.FileHeight = camera.Height;
  photograph.Cam = Resized(camera, std::max(1, static_cast<int>(std::lround(scale * camera.Width))),
    std::max(1, static_cast<int>(std::lround(scale * camera.Height))));
}

double MemoryFor(const std::vector<Camera>& cameras)
{
  // Measured, see tests/README.md: what each photograph keeps, and what is in work at its size.
  constexpr double fixed = 0.2 * GiB;
  constexpr double kept = 17;
  constexpr double inWork = 400;
  double total = 0;
  double largest = 0;
  for (const Camera& camera : cameras)
  {
    const double pixels = static_cast<double>(camera.Width) * camera.Height;
    total += pixels;
    largest = std::max(largest, pixels);
  }
  return fixed + kept * total + inWork * largest;
}

namespace
{
/** Warns when the memory that is free does not suffice for these photographs. */
void NoteMemory(const std::vector<Camera>& cameras, std::vector<ReadingNote>& notes)
{
  const double needed = MemoryFor(cameras);
  const double available = AvailableMemory();
  if (available > 0 && needed > available)
  {
    notes.push_back({ "memory",
      Formatted("about %.1f GiB of memory are needed, ", needed / GiB) +
        Formatted("%.1f GiB are free; ", available / GiB) + "--max-size " +
        std::to_string(SizeWithin(cameras, available)) + " needs less" });
  }
}
}

void LimitSize(DatasetIndex& index, const std::vector<std::string>& exclude,
  const std::optional<double>& maxSize)
{
  std::vector<Photograph> used = WithoutExcluded(index, exclude);
  std::vector<Camera> cameras;
  for (Photograph& photograph : used)
  {
    photograph.Cam = SizedCamera(photograph);
    cameras.push_back(photograph.Cam);
  }
  RequireOneSizePerK(used);
  const auto largest = std::max_element(cameras.begin(), cameras.end(),
    [](const Camera& a, const Camera& b) { return LongerSide(a) < LongerSide(b); });
  const int size = maxSize ? static_cast<int>(*maxSize) : SizeWithin(cameras, DefaultMemory);
  if (size > 0 && size < LongerSide(*largest))
  {
    index.MaxSize = size;
    for (Photograph& photograph : index.Cameras)
    {
      if (PhotographOfName(used, photograph.Name))
      {
        Reduce(photograph, size);
      }
    }
    index.Notes.push_back({ "size",
      "photographs of " + SizeText(largest->Width, largest->Height) + " px are reduced to " +
        std::to_string(size) + " px at most" +
        (maxSize ? ""
                 : ", so that " + Formatted("%.0f GiB", DefaultMemory / GiB) +
              " of memory suffice; --max-size 0 keeps their size") });
  }
  for (std::size_t i = 0; i < used.size(); ++i)
  {
    cameras[i] = SizedCamera(*PhotographOfName(index.Cameras, used[i].Name));
  }
  NoteMemory(cameras, index.Notes);
}
}

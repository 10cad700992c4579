// SPDX-License-Identifier: GPL-3.0-or-later
// A calibration. The first byte is the number of the format in DatasetFormats(), the rest its files,
// which FileMark separates.
#include "FuzzSupport.h"
#include "formats/DatasetFormats.h"

namespace
{
namespace fs = std::filesystem;

/** The files of each format, and the one to be read; in the order of DatasetFormats(). */
struct Layout
{
  const char* Format;
  std::vector<std::string> Files;
};

const std::vector<Layout>& Layouts()
{
  static const std::vector<Layout> layouts = {
    { "middlebury", { "a_par.txt" } },
    { "colmap", { "cameras.txt", "images.txt" } },
    { "colmap-binary", { "cameras.bin", "images.bin" } },
    { "nerf", { "transforms.json" } },
    { "opencv", { "cameras.yml" } },
    { "opencv", { "cameras.xml" } },
    { "bouguet", { "Calib_Results.m" } },
    { "neus", { "cameras_sphere.npz" } },
    { "llff", { "poses_bounds.npy" } },
    { "mvsnet", { "cams/a_cam.txt", "cams/b_cam.txt", "cams/c_cam.txt" } },
    { "numpy", { "a.npz" } },
  };
  return layouts;
}

/** Photographs beside the calibration, for formats that do not name theirs. */
void MakePhotographs(const fs::path& folder)
{
  for (const char* name : { "a.png", "b.png", "c.png" })
  {
    fuzz::WriteFile(folder / name, "");
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
  {
    return 0;
  }
  const Layout& layout = Layouts()[data[0] % Layouts().size()];
  const fs::path folder = fuzz::ScratchFolder() / std::to_string(data[0] % Layouts().size());
  if (!fs::exists(folder))
  {
    MakePhotographs(folder);
  }
  const auto parts = fuzz::Files({ reinterpret_cast<const char*>(data) + 1, size - 1 });
  for (std::size_t i = 0; i < layout.Files.size(); ++i)
  {
    fuzz::WriteFile(folder / layout.Files[i], i < parts.size() ? parts[i] : std::string_view());
  }
  fuzz::ExpectOnlyErrors({ reinterpret_cast<const char*>(data), size },
    [&]
    {
      const novelview::DatasetFormat& format = novelview::FormatOf(layout.Format);
      const std::vector<fs::path> found = format.Find(folder);
      if (!found.empty())
      {
        format.Read(folder, found.front());
      }
    });
  return 0;
}

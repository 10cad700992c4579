// SPDX-License-Identifier: GPL-3.0-or-later
#include "formats/ColmapModel.h"

#include "base/NumberText.h"

#include <algorithm>

namespace novelview
{
namespace
{
constexpr Lens::Model Fisheye = Lens::Model::Fisheye;
constexpr std::array<ColmapModelInfo, 18> Models{ {
  { "SIMPLE_PINHOLE", 3, 1 },
  { "PINHOLE", 4, 2 },
  { "SIMPLE_RADIAL", 4, 1 },
  { "RADIAL", 5, 1 },
  { "OPENCV", 8, 2 },
  { "OPENCV_FISHEYE", 8, 2, Fisheye },
  { "FULL_OPENCV", 12, 2 },
  { "FOV", 5, 0 },
  { "SIMPLE_RADIAL_FISHEYE", 4, 1, Fisheye },
  { "RADIAL_FISHEYE", 5, 1, Fisheye },
  { "THIN_PRISM_FISHEYE", 12, 0 },
  { "RAD_TAN_THIN_PRISM_FISHEYE", 16, 0 },
  { "SIMPLE_DIVISION", 4, 0 },
  { "DIVISION", 5, 0 },
  { "SIMPLE_FISHEYE", 3, 1, Fisheye },
  { "FISHEYE", 4, 2, Fisheye },
  { "EUCM", 6, 0 },
  { "EQUIRECTANGULAR", 2, 0 },
} };
}

const ColmapModelInfo* ColmapInfoOf(const std::string& name)
{
  const auto found = std::find_if(Models.begin(), Models.end(),
    [&name](const ColmapModelInfo& info) { return info.Name == name; });
  return found == Models.end() ? nullptr : &*found;
}

std::string ReadableColmapModels()
{
  std::vector<std::string> names;
  for (const ColmapModelInfo& info : Models)
  {
    if (info.FocalLengths > 0)
    {
      names.emplace_back(info.Name);
    }
  }
  return Joined(names);
}

std::string ColmapModelName(int number)
{
  return number >= 0 && number < static_cast<int>(Models.size())
    ? Models[static_cast<std::size_t>(number)].Name
    : "";
}

int ColmapModelNumber(const std::string& name)
{
  const ColmapModelInfo* info = ColmapInfoOf(name);
  return info ? static_cast<int>(info - Models.data()) : -1;
}

int ColmapParameterCount(const std::string& name)
{
  const ColmapModelInfo* info = ColmapInfoOf(name);
  return info ? info->Parameters : -1;
}
}

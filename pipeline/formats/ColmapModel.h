// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's sources: what COLMAP's files hold, as they hold it.
#ifndef novelview_ColmapModel_h
#define novelview_ColmapModel_h

#include "formats/DatasetFormats.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace novelview
{
/** A line of cameras.txt. */
struct ColmapCamera
{
  std::uint32_t Id = 0;
  std::string Model; ///< "PINHOLE"
  int Width = 0;
  int Height = 0;
  std::vector<double> Parameters; ///< in the model's order
  std::string Where;              ///< for messages
};

/** The first of the two lines of an image in images.txt. */
struct ColmapImage
{
  std::uint32_t Id = 0;
  std::array<double, 4> Rotation{ 1, 0, 0, 0 }; ///< quaternion w x y z, world to camera
  std::array<double, 3> Translation{};
  std::uint32_t CameraId = 0;
  std::string Name;
  std::string Where;
};

/** A sparse model without its points. */
struct ColmapModel
{
  std::vector<ColmapCamera> Cameras;
  std::vector<ColmapImage> Images;
};

/** COLMAP's name for a camera model; empty when the number is unknown. */
std::string ColmapModelName(int number);
/** Its number; -1 when the name is unknown. */
int ColmapModelNumber(const std::string& name);
/** How many parameters a model has; -1 when unknown. */
int ColmapParameterCount(const std::string& name);

/** cameras.txt and images.txt of a folder. Throws Error, naming file and line. */
ColmapModel ReadColmapText(const std::filesystem::path& folder);
/** The same, and an empty points3D.txt. Throws Error when a name has blanks. */
std::vector<FileContent> ComposeColmapText(const ColmapModel& model);

/** cameras.bin and images.bin of a folder. Throws Error, naming file and byte. */
ColmapModel ReadColmapBinary(const std::filesystem::path& folder);
/** The same, and an empty points3D.bin. */
std::vector<FileContent> ComposeColmapBinary(const ColmapModel& model);
}

#endif

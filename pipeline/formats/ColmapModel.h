// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's sources: the contents of COLMAP's files, unconverted.
#ifndef novelview_ColmapModel_h
#define novelview_ColmapModel_h

#include "cameras/Lens.h"

#include <array>
#include <cstdint>
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

/** A camera model of COLMAP; the number is its place in the table. */
struct ColmapModelInfo
{
  const char* Name;
  int Parameters;   ///< how many
  int FocalLengths; ///< 1: f, cx, cy, ..; 2: fx, fy, cx, cy, ..; 0: cannot be read here
  Lens::Model Kind = Lens::Model::Perspective;
};

/** What is known of a camera model; null when its name is unknown. */
const ColmapModelInfo* ColmapInfoOf(const std::string& name);
/** The names of the models that can be read, for messages. */
std::string ReadableColmapModels();

/** COLMAP's name for a camera model; empty when the number is unknown. */
std::string ColmapModelName(int number);
/** Its number; -1 when the name is unknown. */
int ColmapModelNumber(const std::string& name);
/** How many parameters a model has; -1 when unknown. */
int ColmapParameterCount(const std::string& name);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
// A job file or, when the first byte is odd, the camera path of a video. The rest is the file.
#include "FuzzSupport.h"
#include "commands/RunOptions.h"
#include "video/CameraTrajectory.h"

namespace
{
novelview::DatasetIndex ThreeCameras()
{
  novelview::DatasetIndex dataset;
  for (int i = 0; i < 3; ++i)
  {
    novelview::Photograph photograph;
    photograph.Name = std::string(1, static_cast<char>('a' + i)) + ".png";
    Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
    K.diagonal() << 50, 50, 1;
    photograph.Cam = novelview::LookAt(
      Eigen::Vector3d(3, i - 1, 0.5), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ(), K, 64, 48);
    dataset.Cameras.push_back(photograph);
  }
  return dataset;
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
  {
    return 0;
  }
  const std::filesystem::path file = fuzz::ScratchFolder() / "job.json";
  fuzz::WriteFile(file, { reinterpret_cast<const char*>(data) + 1, size - 1 });
  fuzz::ExpectOnlyErrors({ reinterpret_cast<const char*>(data), size },
    [&]
    {
      if (data[0] % 2 == 0)
      {
        novelview::MakeRunOptions(file, {});
        return;
      }
      static const novelview::DatasetIndex dataset = ThreeCameras();
      novelview::TrajectoryOptions options;
      options.Path = file;
      options.Frames = 5; // the file may ask for a video of any length
      novelview::CamerasOfFrames(options, dataset);
    });
  return 0;
}

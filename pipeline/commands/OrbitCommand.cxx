// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/OrbitCommand.h"

#include "ViewAccess.h"
#include "base/AtomicFile.h"
#include "base/InputFile.h"
#include "commands/CommandSupport.h"
#include "core/Error.h"
#include "formats/Middlebury.h"
#include "images/ImageFile.h"
#include "processes/WorkDistributor.h"
#include "video/CameraTrajectory.h"
#include "video/VideoFile.h"

#include <cstdio>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
std::string FrameName(std::size_t frame)
{
  char name[32];
  std::snprintf(name, sizeof(name), "frame_%04zu.png", frame);
  return name;
}

/** Where the images go; empty = nowhere. */
fs::path FramesFolder(const OrbitOptions& options)
{
  return !options.FramesDir.empty() || IsVideoName(options.Out) ? options.FramesDir : options.Out;
}

/** What FrameFolder writes into its folder. */
std::vector<fs::path> FilesOfFrames(std::size_t count)
{
  std::vector<fs::path> files{ "frames_par.txt" };
  for (std::size_t frame = 0; frame < count; ++frame)
  {
    files.emplace_back(FrameName(frame));
    files.push_back(fs::path("mask") / FrameName(frame));
  }
  return files;
}

/** A name that looks like a file's, but of no video, is an error and not a folder. */
void CheckOut(const fs::path& out)
{
  std::error_code failure;
  const bool folder = fs::is_directory(out, failure);
  if (!IsVideoName(out) && out.has_extension() && !folder)
  {
    throw UsageError("--out", "is not a video that can be written", out.filename().string(),
      VideoExtensions() + ", or a folder");
  }
  if (IsVideoName(out) && folder)
  {
    throw UsageError("--out", "is a folder, not a video", out.string(), "another name");
  }
}

/** The frames' images and cameras in a folder. */
class FrameFolder
{
public:
  FrameFolder(fs::path folder, const std::vector<Camera>& cameras)
    : Folder(std::move(folder))
    , Cameras(cameras)
  {
  }
  void Add(std::size_t frame, vtkImageData* picture) const
  {
    if (!this->Folder.empty())
    {
      WriteArray(this->Folder / FrameName(frame), picture, arrays::Color);
      WriteArray(this->Folder / "mask" / FrameName(frame), picture, arrays::Mask);
    }
  }
  void Finish() const
  {
    std::vector<NamedCamera> named;
    for (std::size_t frame = 0; frame < this->Cameras.size(); ++frame)
    {
      named.push_back({ FrameName(frame), this->Cameras[frame] });
    }
    if (!this->Folder.empty())
    {
      WriteCameras(this->Folder / "frames_par.txt", named);
    }
  }

private:
  fs::path Folder;
  const std::vector<Camera>& Cameras;
};

/** Makes every frame and hands it, in order, to the folder and to the video if there is one. */
void MakeFrames(const OrbitOptions& options, const std::vector<Camera>& cameras,
  Synthesis& synthesis, WorkDistributor& work, Console& console, VideoFile* video)
{
  const FrameFolder folder(FramesFolder(options), cameras);
  const auto make = [&](std::size_t frame)
  {
    try
    {
      WorkResult result;
      result.Images.push_back(PictureOnly(synthesis.Render(cameras[frame], options.UpTo).Image));
      return result;
    }
    catch (const Interrupted&)
    {
      throw;
    }
    catch (const Error& error)
    {
      throw Error("frame " + std::to_string(frame), error.what());
    }
  };
  const auto take = [&](std::size_t frame, const WorkResult& result)
  {
    console.RunTimed("report",
      [&]
      {
        vtkImageData* picture = result.Images.front();
        folder.Add(frame, picture);
        if (video)
        {
          video->Add(TopDownArray<const std::uint8_t>(picture, arrays::Color, 3, "frame", true));
        }
      });
    console.Info("frame " + std::to_string(frame + 1) + " of " + std::to_string(cameras.size()));
  };
  work.ForEach(cameras.size(), make, take);
  if (work.Writes())
  {
    folder.Finish();
  }
}
}

void RenderOrbit(const OrbitOptions& options, Console& console, ProcessGroup& processes)
{
  WorkDistributor work(console, processes, options.Threads);
  CheckOut(options.Out);
  const DatasetIndex index = FindInput(options.Input);
  const std::vector<Camera> cameras = CamerasOfFrames(options, index, options.Input.Exclude);
  const bool video = IsVideoName(options.Out);
  if (work.Writes())
  {
    if (video)
    {
      AnnounceOutput(options.Out);
      RequireWritable(fs::absolute(options.Out).parent_path());
    }
    if (const fs::path folder = FramesFolder(options); !folder.empty())
    {
      PrepareFolder(folder, FilesOfFrames(cameras.size()));
    }
  }
  const auto film = [&](VideoFile* to)
  {
    const Dataset dataset =
      work.Writes() ? ReadInput(options.Input, index, {}, console) : Dataset();
    const auto synthesis = work.Prepare(dataset.Views, options.Synthesis);
    MakeFrames(options, cameras, *synthesis, work, console, to);
  };
  if (video && work.Writes())
  {
    WriteAtomically(options.Out,
      [&](const fs::path& temporary)
      {
        // Opened before any work is done, since there may be no codec.
        VideoFile file(temporary, cameras.front().Width, cameras.front().Height, options.Fps);
        film(&file);
        return file.Close();
      });
  }
  else
  {
    film(nullptr);
  }
  console.Info((video ? "video: " : "frames: ") + options.Out.string());
  console.Summary();
}
}

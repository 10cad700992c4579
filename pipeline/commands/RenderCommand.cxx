// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/RenderCommand.h"

#include "ViewAccess.h"
#include "cameras/PhotographFiles.h"
#include "commands/CommandSupport.h"
#include "dataset/ViewSpec.h"
#include "images/ImageFile.h"
#include "processes/WorkDistributor.h"

namespace novelview
{
namespace fs = std::filesystem;

void RenderViews(const RenderOptions& options, Console& console, ProcessGroup& processes)
{
  WorkDistributor work(console, processes, options.Threads);
  const DatasetIndex index = FindInput(options.Input);
  const std::vector<Photograph> cameras = ReadViewCameras(options.Cameras);
  std::vector<fs::path> pictures;
  for (const Photograph& camera : cameras)
  {
    pictures.emplace_back(PictureNameOf(camera.Name));
  }
  Dataset dataset;
  if (work.Writes())
  {
    std::vector<fs::path> files = pictures;
    for (const fs::path& picture : pictures)
    {
      files.push_back("mask" / picture);
    }
    PrepareFolder(options.Out, files);
    dataset = ReadInput(options.Input, index, {}, console);
  }
  const auto synthesis = work.Prepare(dataset.Views, options.Synthesis);
  const auto make = [&](std::size_t item)
  {
    ViewSpec spec;
    spec.What = ViewSpec::Kind::File;
    spec.ParFile = options.Cameras;
    spec.Name = cameras[item].Name;
    const ResolvedView view = ResolveViewSpec(spec, index);
    ValidateCamera(view.Cam, spec.Name);
    WorkResult result;
    result.Images.push_back(PictureOnly(synthesis->Render(view.Cam, options.UpTo).Image));
    return result;
  };
  const auto take = [&](std::size_t item, const WorkResult& result)
  {
    const fs::path& name = pictures[item];
    console.RunTimed("report",
      [&]
      {
        WriteArray(options.Out / name, result.Images.front(), arrays::Color);
        WriteArray(options.Out / "mask" / name, result.Images.front(), arrays::Mask);
      });
    console.Info((options.Out / name).string());
  };
  work.ForEach(cameras.size(), make, take);
  console.Summary();
}
}

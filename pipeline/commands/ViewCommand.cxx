// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/ViewCommand.h"

#include "Threads.h"
#include "ViewAccess.h"
#include "cameras/CameraGrid.h"
#include "cameras/CameraUp.h"
#include "commands/BrowserStart.h"
#include "commands/CommandSupport.h"
#include "commands/LiveFrame.h"
#include "live/LiveServer.h"
#include "synthesis/SceneGeometry.h"

#include <nlohmann/json.hpp>

#include <atomic>
#include <optional>

namespace novelview
{
namespace
{
std::vector<double> NumbersOf(const Eigen::Matrix3d& matrix)
{
  const Eigen::Matrix3d byRows = matrix.transpose();
  return { byRows.data(), byRows.data() + byRows.size() };
}

/** The cameras of the photographs and what they look at, for the page. */
std::string StateOf(vtkMultiBlockDataSet* views)
{
  std::vector<Camera> cameras;
  nlohmann::json state;
  for (unsigned int viewId = 0; viewId < views->GetNumberOfBlocks(); ++viewId)
  {
    const std::string name = ViewName(views, viewId);
    const Camera camera = AttachedCamera(ViewImage(views, viewId), name);
    cameras.push_back(camera);
    state["cameras"].push_back({ { "name", name }, { "K", NumbersOf(camera.K) },
      { "R", NumbersOf(camera.R) }, { "T", { camera.T.x(), camera.T.y(), camera.T.z() } },
      { "width", camera.Width }, { "height", camera.Height } });
  }
  const Eigen::Vector3d target = CommonTarget(cameras.data(), cameras.size());
  const Eigen::Vector3d up = UpOfCameras(cameras);
  state["target"] = { target.x(), target.y(), target.z() };
  state["up"] = { up.x(), up.y(), up.z() };
  return state.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/** Reports to the console, and until there is a state with cameras to the page. */
SynthesisListener ListenerFor(
  Console& console, LiveServer& server, const std::atomic<bool>& prepared)
{
  SynthesisListener listener = ListenerFor(console);
  listener.Progress = [&](const std::string& stage, double fraction)
  {
    if (prepared)
    {
      return !Console::Interrupted();
    }
    server.SetState(nlohmann::json{ { "stage", stage }, { "fraction", fraction } }.dump());
    return console.Progress(stage, fraction);
  };
  listener.StageDone = [&](const std::string& stage, double seconds)
  {
    if (!prepared)
    {
      console.StageDone(stage, seconds);
    }
  };
  return listener;
}
}

void ServeView(const ViewOptions& options, Console& console)
{
  SetNumberOfThreads(options.Threads);
  const DatasetIndex index = FindInput(options.Input);
  LiveServer server(options.Listen, options.Port);
  if (options.Listen != "127.0.0.1" && options.Listen != "localhost")
  {
    console.Warn("--listen " + options.Listen + ": other computers can reach the page");
  }
  console.Info("page: " + server.Address());
  std::optional<BrowserStart> browser;
  if (options.Open && BrowserStart::HasDisplay())
  {
    browser.emplace(server.Address());
    if (!browser->Started())
    {
      console.Info("no browser could be started (xdg-open); open the page yourself");
    }
  }
  server.SetState(R"({"stage":"photographs"})");
  const Dataset dataset = ReadInput(options.Input, index, {}, console);
  std::atomic<bool> prepared = false;
  Synthesis synthesis(dataset.Views, options.Synthesis, ListenerFor(console, server, prepared));
  synthesis.Prepared();
  prepared = true;
  server.SetThumbnails(ThumbnailsOf(synthesis.Photographs()));
  server.SetState(StateOf(synthesis.Photographs()));
  console.Info("ready; Ctrl-C ends");
  const CameraGrid grid(index.Cameras); // as `render` has them
  while (!Console::Interrupted())
  {
    if (const auto ticket = server.Frames().Take(std::chrono::milliseconds(100)))
    {
      server.Frames().Give(ticket, MakeLiveFrame(synthesis, grid, ticket->Request));
    }
  }
}
}

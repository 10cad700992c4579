// SPDX-License-Identifier: GPL-3.0-or-later
#include "check/CheckPicture.h"

#include "ViewAccess.h"
#include "core/Error.h"
#include "drawing/Canvas.h"
#include "drawing/SceneActors.h"
#include "images/ImageFile.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr int PictureWidth = 1600;
constexpr int PictureHeight = 900;
constexpr Colour PointInk = { 0.80, 0.78, 0.70 };

bool HasFinding(const CheckReport& report, const std::string& view)
{
  return std::any_of(report.Findings.begin(), report.Findings.end(),
    [&](const CheckFinding& finding)
    { return finding.View == view && finding.Severity != CheckSeverity::Note; });
}

/** A photograph as small as it is drawn; null when it cannot be read. */
vtkSmartPointer<vtkImageData> SmallPhotograph(const Photograph& photograph)
{
  constexpr int DrawnSize = 256;
  try
  {
    const Image<std::uint8_t> color = ReadColorFile(photograph.File, photograph.Reading);
    const int every = std::max(1, std::max(color.Width, color.Height) / DrawnSize);
    Image<std::uint8_t> small(color.Width / every, color.Height / every, 3);
    for (int y = 0; y < small.Height; ++y)
    {
      for (int x = 0; x < small.Width; ++x)
      {
        for (int channel = 0; channel < 3; ++channel)
        {
          small(x, y, channel) = color(x * every, y * every, channel);
        }
      }
    }
    auto picture = NewImage(small.Width, small.Height);
    SetPixels(picture, arrays::Color, small.Ref());
    return picture;
  }
  catch (const Error&)
  {
    return nullptr;
  }
}

vtkSmartPointer<vtkActor> PointsActor(const std::vector<Eigen::Vector3d>& places)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  for (const Eigen::Vector3d& place : places)
  {
    cells->InsertNextCell({ points->InsertNextPoint(place.data()) });
  }
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  cloud->SetVerts(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(cloud);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(PointInk[0], PointInk[1], PointInk[2]);
  actor->GetProperty()->SetPointSize(2);
  actor->GetProperty()->LightingOff();
  return actor;
}

/** What the cameras look at: the middle of the hull's points or, without any, of the axes. */
Eigen::Vector3d TargetOf(const CheckReport& report)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : report.HullPoints)
  {
    sum += point;
  }
  if (!report.HullPoints.empty())
  {
    return sum / static_cast<double>(report.HullPoints.size());
  }
  std::vector<Camera> cameras;
  for (const Photograph& photograph : report.Cameras)
  {
    cameras.push_back(photograph.Cam);
  }
  return CommonTarget(cameras.data(), cameras.size());
}

/** One view of the scene. */
void AddScene(Canvas& canvas, const Box& box, const CheckReport& report,
  const std::vector<SceneCamera>& cameras, const Eigen::Vector3d& target, bool fromAbove)
{
  vtkRenderer* scene = canvas.AddPanel(box, colours::Panel);
  scene->AddActor(PointsActor(report.HullPoints));
  double distance = 0;
  for (const SceneCamera& camera : cameras)
  {
    distance = std::max(distance, (camera.Cam.Centre() - target).norm());
  }
  FrustumStyle style;
  style.Target = target;
  style.LabelSizePx = 18;
  style.Depth = 0.2 * (distance > 0 ? distance : 1);
  std::vector<Eigen::Vector3d> extent = report.HullPoints;
  std::vector<SceneCamera> drawn = cameras;
  JoinLabels(drawn, 0.06 * distance);
  for (const SceneCamera& camera : drawn)
  {
    AddCameraToScene(scene, camera, style, &extent);
  }
  const Eigen::Vector3d up = UpOf(drawn);
  const Eigen::Vector3d side = up.unitOrthogonal();
  const double tilt = 32 * EIGEN_PI / 180;
  const Eigen::Vector3d towards = fromAbove
    ? Eigen::Vector3d(-up)
    : Eigen::Vector3d(-std::cos(tilt) * side - std::sin(tilt) * up);
  FitScene(
    scene, extent, towards, fromAbove ? side : up, static_cast<double>(box.Width) / box.Height);
  AddAxes(canvas, { box.X + 12, box.Y + box.Height - 112, 100, 100 }, scene, colours::Panel);
  canvas.AddText(
    fromAbove ? "from above" : "obliquely", box.X + 16, box.Y + 22, { 15, colours::FaintText });
}
}

void DrawCheckedCameras(const CheckReport& report, const std::filesystem::path& path)
{
  Canvas canvas(PictureWidth, PictureHeight, colours::Desktop);
  std::size_t odd = 0;
  std::vector<SceneCamera> cameras;
  for (std::size_t i = 0; i < report.Cameras.size(); ++i)
  {
    const bool finding = HasFinding(report, report.Cameras[i].Name);
    odd += finding;
    cameras.push_back(
      { report.Cameras[i].Cam, std::to_string(i), finding ? colours::Outline : colours::Reference,
        finding, SmallPhotograph(report.Cameras[i]) });
  }
  const std::string name = std::filesystem::absolute(report.Folder).lexically_normal().filename();
  canvas.AddText(name + ": " + std::to_string(cameras.size()) +
      " cameras, numbered in the order of " + report.Calibration.filename().string(),
    Gap + 8, TitleHeight / 2, { 19, colours::Text, true });
  if (odd > 0)
  {
    canvas.AddText(std::to_string(odd) + " with findings", PictureWidth - Gap - 8, TitleHeight / 2,
      { 17, colours::Outline, true, TextStyle::Right });
  }
  const int width = (PictureWidth - 3 * Gap) / 2;
  const Eigen::Vector3d target = TargetOf(report);
  for (const bool above : { false, true })
  {
    const Box box = { above ? 2 * Gap + width : Gap, TitleHeight, width,
      PictureHeight - TitleHeight - Gap };
    AddScene(canvas, box, report, cameras, target, above);
  }
  WriteArray(path, canvas.Draw(), arrays::Color);
}
}

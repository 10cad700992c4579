// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/ScenePictures.h"

#include "ViewAccess.h"
#include "base/NumberText.h"
#include "core/Error.h"
#include "drawing/Canvas.h"
#include "drawing/ErrorPicture.h"
#include "drawing/SceneActors.h"
#include "drawing/ScoreChart.h"
#include "images/ImageFile.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkPolyDataNormals.h>
#include <vtkProperty.h>

#include <algorithm>
#include <cmath>

namespace novelview
{
namespace
{
constexpr int DesktopWidth = 1600;
constexpr int DesktopHeight = 900;

/** From grey (has not moved) over green to blue. */
vtkSmartPointer<vtkColorTransferFunction> MoveColours(double most)
{
  auto table = vtkSmartPointer<vtkColorTransferFunction>::New();
  table->AddRGBPoint(0.00 * most, 0.80, 0.80, 0.78);
  table->AddRGBPoint(0.33 * most, 0.48, 0.78, 0.60);
  table->AddRGBPoint(0.67 * most, 0.16, 0.56, 0.66);
  table->AddRGBPoint(1.00 * most, 0.20, 0.20, 0.62);
  return table;
}

Eigen::AlignedBox3d BoundsOf(vtkPolyData* mesh)
{
  double bounds[6];
  mesh->GetBounds(bounds);
  return { Eigen::Vector3d(bounds[0], bounds[2], bounds[4]),
    Eigen::Vector3d(bounds[1], bounds[3], bounds[5]) };
}

void AddCorners(const Eigen::AlignedBox3d& box, std::vector<Eigen::Vector3d>& points)
{
  for (int corner = 0; corner < 8; ++corner)
  {
    points.push_back(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
  }
}

/** The view of a scene: `azimuthDeg` beside where `camera` stands, `elevationDeg` above it. */
Eigen::Vector3d ObliqueView(
  const Camera& camera, const Eigen::Vector3d& up, double azimuthDeg, double elevationDeg)
{
  const double radians = EIGEN_PI / 180;
  const Eigen::Vector3d level =
    (camera.OpticalAxis() - camera.OpticalAxis().dot(up) * up).norm() > 0.1
    ? (camera.OpticalAxis() - camera.OpticalAxis().dot(up) * up).normalized()
    : up.unitOrthogonal();
  const Eigen::Vector3d turned = Eigen::AngleAxisd(azimuthDeg * radians, up) * level;
  return std::cos(elevationDeg * radians) * turned - std::sin(elevationDeg * radians) * up;
}

void AddTitleBar(Canvas& canvas, int width, const std::string& title, const std::string& state)
{
  canvas.AddPanel({ 0, 0, width, TitleHeight }, colours::TitleBar);
  TextStyle style{ 19, colours::Text, true };
  canvas.AddText("NovelView", 16, TitleHeight / 2, style);
  canvas.AddText(title, 136, TitleHeight / 2, { 16, colours::FaintText });
  style.Align = TextStyle::Right;
  style.Ink = colours::Novel;
  canvas.AddText(state, width - 16, TitleHeight / 2, style);
}

/** A panel with a heading; returns what is left for its contents. */
Box AddHeadedPanel(Canvas& canvas, const Box& box, const std::string& heading)
{
  canvas.AddPanel(box, colours::Panel);
  canvas.AddText(heading, box.X + 12, box.Y + HeaderHeight / 2 + 1, { 15, colours::Text, true });
  return { box.X + Gap, box.Y + HeaderHeight, box.Width - 2 * Gap,
    box.Height - HeaderHeight - Gap };
}
}

//------------------------------------------------------------------------------
void DrawRig(const RigPicture& rig, const std::filesystem::path& path)
{
  Canvas canvas(DesktopWidth, DesktopHeight, colours::Desktop);
  AddTitleBar(canvas, DesktopWidth, rig.Title, "rig");
  const Box box = { Gap, TitleHeight + Gap, DesktopWidth - 2 * Gap,
    DesktopHeight - TitleHeight - 2 * Gap };
  vtkRenderer* scene = canvas.AddPanel(box, colours::Panel);

  double centre[3];
  vtkSmartPointer<vtkActor> object = NewTexturedActor(rig.Mesh, rig.Look, centre);
  object->SetPosition(centre);
  scene->AddActor(object);

  std::vector<SceneCamera> cameras;
  for (std::size_t viewId = 0; viewId < rig.Views.size(); ++viewId)
  {
    SceneCamera camera{ rig.Views[viewId], std::to_string(viewId), colours::Reference, false, {} };
    camera.Picture = viewId < rig.Photographs.size() ? rig.Photographs[viewId] : nullptr;
    cameras.push_back(camera);
  }
  for (std::size_t id = 0; id < rig.HeldOut.size(); ++id)
  {
    const std::string label = id < rig.HeldOutLabels.size() ? rig.HeldOutLabels[id] : "held out";
    cameras.push_back({ rig.HeldOut[id], label, colours::Novel, true, {} });
  }
  FrustumStyle style;
  style.Target = Eigen::Vector3d(centre);
  style.LabelSizePx = 20;
  std::vector<Eigen::Vector3d> extent;
  AddCorners(BoundsOf(rig.Mesh), extent);
  JoinLabels(cameras, 0.06 * (rig.Views.front().Centre() - style.Target).norm());
  for (const SceneCamera& camera : cameras)
  {
    style.Depth = 0.26 * (camera.Cam.Centre() - style.Target).norm();
    AddCameraToScene(scene, camera, style, &extent);
  }
  const Eigen::Vector3d up = UpOf(cameras);
  FitScene(scene, extent, ObliqueView(rig.Views.front(), up, -8, 32), up,
    static_cast<double>(box.Width) / box.Height);
  AddAxes(canvas, { box.X + 12, box.Y + box.Height - 132, 120, 120 }, scene, colours::Panel);

  const int y = box.Y + 26;
  canvas.AddText(
    std::to_string(rig.Views.size()) + " photographs", box.X + 20, y, { 17, colours::Reference });
  if (!rig.HeldOut.empty())
  {
    canvas.AddText(std::to_string(rig.HeldOut.size()) + " " + rig.HeldOutName +
        (rig.HeldOut.size() == 1 ? "" : "s"),
      box.X + 20, y + 26, { 17, colours::Novel });
  }
  WriteArray(path, canvas.Draw(), arrays::Color);
}

namespace
{
/** The mesh with its displacement in novel-view pixels as scalars. */
vtkSmartPointer<vtkActor> MeshActor(const Dashboard& state, vtkScalarsToColors* colours)
{
  vtkNew<vtkPolyData> shown;
  shown->SetPoints(state.Mesh->GetPoints());
  shown->SetPolys(state.Mesh->GetPolys());
  vtkDataArray* displacement = state.Mesh->GetPointData()->GetArray(arrays::Displacement);
  vtkNew<vtkFloatArray> moved;
  moved->SetNumberOfTuples(shown->GetNumberOfPoints());
  for (vtkIdType ptId = 0; ptId < shown->GetNumberOfPoints(); ++ptId)
  {
    double pixels = 0;
    if (displacement && displacement->GetNumberOfComponents() == 3)
    {
      double move[3];
      displacement->GetTuple(ptId, move);
      const double depth = state.Novel.Depth(Eigen::Vector3d(shown->GetPoint(ptId)));
      pixels = Eigen::Vector3d(move).norm() / state.Novel.PixelFootprint(std::abs(depth));
    }
    moved->SetValue(ptId, static_cast<float>(pixels));
  }
  shown->GetPointData()->SetScalars(moved);
  vtkNew<vtkPolyDataNormals> normals;
  normals->SetInputData(shown);
  normals->SplittingOff();
  normals->ConsistencyOff();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(normals->GetOutputPort());
  mapper->SetLookupTable(colours);
  mapper->UseLookupTableScalarRangeOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.75);
  return actor;
}

/** The outline points as dots, and how many there are. */
vtkSmartPointer<vtkActor> OutlineActor(vtkPolyData* mesh, vtkIdType& count)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> dots;
  vtkDataArray* flags = mesh->GetPointData()->GetArray(arrays::OutlineFlag);
  for (vtkIdType ptId = 0; flags && ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    if (flags->GetComponent(ptId, 0) != 0)
    {
      dots->InsertNextCell({ points->InsertNextPoint(mesh->GetPoint(ptId)) });
    }
  }
  count = points->GetNumberOfPoints();
  vtkNew<vtkPolyData> shown;
  shown->SetPoints(points);
  shown->SetVerts(dots);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(shown);
  mapper->SetResolveCoincidentTopologyToPolygonOffset();
  mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-8);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetPointSize(5);
  actor->GetProperty()->SetColor(colours::Outline[0], colours::Outline[1], colours::Outline[2]);
  actor->GetProperty()->LightingOff();
  return actor;
}

void DrawMeshScene(Canvas& canvas, const Box& box, const Dashboard& state)
{
  vtkRenderer* scene = canvas.AddPanel(box, colours::Panel);
  auto table = MoveColours(state.DisplacementRangePx);
  vtkIdType outlinePoints = 0;
  scene->AddActor(MeshActor(state, table));
  scene->AddActor(OutlineActor(state.Mesh, outlinePoints));

  std::vector<SceneCamera> cameras;
  std::vector<double> distances;
  const Eigen::AlignedBox3d bounds = BoundsOf(state.Mesh);
  for (const View& view : ReadViews(state.Views, { false, false, false }))
  {
    cameras.push_back({ view.Cam, std::to_string(cameras.size()), colours::Reference, false, {} });
    distances.push_back((view.Cam.Centre() - bounds.center()).norm());
  }
  cameras.push_back({ state.Novel, "novel", colours::Novel, true, {} });
  std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
  const double typical = distances[distances.size() / 2];
  JoinLabels(cameras, 0.06 * typical);

  FrustumStyle style;
  style.Target = bounds.center();
  style.NearerBy = std::min(1.0, 0.95 * bounds.diagonal().norm() / typical);
  style.Depth = 0.2 * style.NearerBy * typical;
  std::vector<Eigen::Vector3d> extent;
  AddCorners(bounds, extent);
  for (const SceneCamera& camera : cameras)
  {
    AddCameraToScene(scene, camera, style, &extent);
  }
  const Eigen::Vector3d up = UpOf(cameras);
  FitScene(scene, extent, ObliqueView(state.Novel, up, -14, 38), up,
    static_cast<double>(box.Width) / box.Height);

  canvas.AddText("Mesh: " + std::to_string(state.Mesh->GetNumberOfPoints()) + " points", box.X + 16,
    box.Y + 20, { 15, colours::Text, true });
  canvas.AddText("outline points (" + std::to_string(outlinePoints) + ")", box.X + 16, box.Y + 44,
    { 15, colours::Outline });
  canvas.AddText(
    "other visible points, by displacement", box.X + 16, box.Y + 66, { 15, { 0.48, 0.78, 0.60 } });
  canvas.AddText("references", box.X + 16, box.Y + 88, { 15, colours::Reference });
  if (style.NearerBy < 1)
  {
    canvas.AddText(
      "(cameras drawn at " + Formatted("%.0f", 100 * style.NearerBy) + " % of their distance)",
      box.X + 104, box.Y + 88, { 13, colours::FaintText });
  }
  canvas.AddText("displacement, px", box.X + box.Width - 16, box.Y + 20,
    { 14, colours::Text, false, TextStyle::Right });
  canvas.AddColourBar(table, { box.X + box.Width - 84, box.Y + 40, 76, 190 }, "%.1f");
  AddAxes(canvas, { box.X + 8, box.Y + box.Height - 108, 100, 100 }, scene, colours::Panel);
}

void DrawPicturePanels(Canvas& canvas, const Box& area, const Dashboard& state)
{
  if (!state.TruthImage)
  {
    canvas.AddPicture(state.NovelImage, AddHeadedPanel(canvas, area, "Novel view"));
    return;
  }
  const int width = (area.Width - Gap) / 2;
  const int height = (area.Height - Gap) / 2;
  const int right = area.X + width + Gap;
  const int lower = area.Y + height + Gap;
  canvas.AddPicture(
    state.NovelImage, AddHeadedPanel(canvas, { area.X, area.Y, width, height }, "Novel view"));
  canvas.AddPicture(
    state.TruthImage, AddHeadedPanel(canvas, { right, area.Y, width, height }, "Truth"));
  auto table = HeatColours(state.ErrorRange);
  const int barWidth = 64;
  Box map =
    AddHeadedPanel(canvas, { area.X, lower, width, height }, "Error |novel - truth|, grey levels");
  map.Width -= barWidth;
  map = canvas.AddPicture(ErrorPicture(state.NovelImage, state.TruthImage, table), map);
  canvas.AddColourBar(table, { map.X + map.Width + Gap, map.Y, barWidth, map.Height }, "%.0f");

  const bool scored = !state.History.empty();
  const std::string heading = scored
    ? "RMS per iteration: " + Formatted("%.2f", state.History.back().Rms)
    : "RMS per iteration";
  const Box chart = AddHeadedPanel(canvas, { right, lower, width, height }, heading);
  canvas.AddText("outline", chart.X + chart.Width - 96, lower + HeaderHeight / 2 + 1,
    { 13, colours::Outline, false, TextStyle::Right });
  canvas.AddText("non-outline", chart.X + chart.Width - 4, lower + HeaderHeight / 2 + 1,
    { 13, colours::NonOutline, false, TextStyle::Right });
  canvas.AddChart(NewScoreChart(state.History, {}), chart, colours::Panel);
}
}

//------------------------------------------------------------------------------
void DrawDesktop(Dashboard& state, const std::filesystem::path& path)
{
  if (!state.Mesh || !state.Views || !state.NovelImage)
  {
    throw Error("screenshot", "mesh, views and novel view are all needed");
  }
  if (!state.Window)
  {
    state.Window = std::make_shared<OffscreenWindow>(DesktopWidth, DesktopHeight);
  }
  Canvas canvas(DesktopWidth, DesktopHeight, colours::Desktop, state.Window);
  const std::string stage =
    state.Step == Stage::Full ? "non-outline" : (state.Step == Stage::Outline ? "outline" : "hull");
  AddTitleBar(canvas, DesktopWidth, state.Title,
    state.Step == Stage::Hull ? stage
                              : stage + " deformer, iteration " + std::to_string(state.Iteration));
  const int top = TitleHeight + Gap;
  const int height = DesktopHeight - top - Gap;
  const Box left = { Gap, top, 780, height };
  const int rightX = left.X + left.Width + Gap;
  DrawMeshScene(canvas, left, state);
  DrawPicturePanels(canvas, { rightX, top, DesktopWidth - rightX - Gap, height }, state);
  WriteArray(path, canvas.Draw(), arrays::Color);
}

//------------------------------------------------------------------------------
void DrawCharts(const std::string& title, const std::vector<HistoryRow>& history,
  const std::filesystem::path& path)
{
  ChartPage page(title);
  ChartStyle style = page.Style;
  style.ScoreName = "RMS, grey levels";
  const bool hasSsim = std::any_of(
    history.begin(), history.end(), [](const HistoryRow& row) { return std::isfinite(row.Ssim); });
  const int chartWidth = hasSsim ? ChartPage::Width / 2 : ChartPage::Width;
  page.Sheet.AddChart(
    NewScoreChart(history, style), { 10, 56, chartWidth - 20, ChartPage::Height - 66 }, page.Paper);
  if (hasSsim)
  {
    style.Score = &HistoryRow::Ssim;
    style.ScoreName = "SSIM";
    style.LegendBelow = true; // better scores are higher
    page.Sheet.AddChart(NewScoreChart(history, style),
      { chartWidth + 10, 56, chartWidth - 20, ChartPage::Height - 66 }, page.Paper);
  }
  WriteArray(path, page.Sheet.Draw(), arrays::Color);
}
}

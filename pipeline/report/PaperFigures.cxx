// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/PaperFigures.h"

#include "ViewAccess.h"
#include "base/NumberText.h"
#include "base/Parallel.h"
#include "drawing/ShadedMesh.h"
#include "images/ImageFile.h"
#include "mesh/MeshFile.h"
#include "report/ReportPictures.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <optional>

namespace novelview
{
namespace fs = std::filesystem;

namespace
{
constexpr double SideAngleDeg = 60;
constexpr int MarginPx = 6;
constexpr int FigureSidePx = 480;
constexpr int RowSidePx = 560;

/** A picture of the row: what the novel view is, and the mesh it is made with. */
struct RowItem
{
  std::string Caption;
  fs::path Picture; ///< the novel view; empty = that of the truth
  fs::path Mesh;    ///< empty = the true mesh
  bool HasFaces = true;
};

std::string WithRms(const std::string& name, const std::optional<Scores>& scores)
{
  return scores ? name + ", RMS " + Formatted("%.2f", scores->Rms) : name;
}

/** Tables 1 to 4: the RMS after every iteration, in one row. */
ReportTable TimesTable(const RunReport& report, Stage step)
{
  const bool outline = step == Stage::Outline;
  ReportTable table;
  table.Id = outline ? "table-paper-outline" : "table-paper-nonoutline";
  table.Caption = outline ? "RMS error for every outline points refinement"
                          : "RMS error for every non-outline points refinement";
  table.Columns = { "times" };
  std::vector<ReportCell> cells{ ReportCell("RMS error") };
  for (const TableRow& row : report.Iterations())
  {
    if (row.Step == step && row.Score)
    {
      table.Columns.push_back(std::to_string(row.Iteration));
      cells.emplace_back(row.Score->Rms, "%.2f");
    }
  }
  table.Rows.push_back(cells);
  return table;
}

/** Initial mesh, culled mesh, some iterations of both deformers, truth. */
std::vector<RowItem> RowItems(const RunPageInput& input)
{
  const RunReport& report = *input.Report;
  const fs::path hull = input.Folder / "stages" / "hull.png";
  std::vector<RowItem> items = { { "initial mesh", hull, input.Folder / "meshes/power_crust.vtp" },
    { "culled", hull, input.Folder / "meshes/hull.vtp",
      report.Iterations().front().Triangles > 0 } };
  for (const Stage step : { Stage::Outline, Stage::Full })
  {
    const std::string name = step == Stage::Outline ? "outline " : "non-outline ";
    const std::vector<TableRow>& rows = report.Iterations();
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      const int times = rows[i].Iteration;
      const bool last = i + 1 == rows.size() || rows[i + 1].Step != step;
      if (rows[i].Step == step && times > 0 &&
        (times == 1 || times == 2 || times == 5 || times == 10 || last))
      {
        const std::string file = IterationName(step, times);
        items.push_back({ WithRms(name + std::to_string(times), rows[i].Score),
          input.Folder / "iterations" / (file + ".png"),
          input.Folder / "meshes/iterations" / (file + ".vtp"), rows[i].Triangles > 0 });
      }
    }
  }
  if (report.TrueImage())
  {
    items.push_back({ "truth", {}, {} });
  }
  return items;
}

/** The mesh of a file that the run has written, or the true mesh. */
TriangleMesh MeshOf(const RunPageInput& input, const RowItem& item)
{
  vtkSmartPointer<vtkPolyData> mesh = input.TrueMesh;
  if (!item.Mesh.empty())
  {
    mesh = item.HasFaces ? ReadMeshFile(item.Mesh) : nullptr;
  }
  return mesh ? ToTriangleMesh(mesh, item.Caption) : TriangleMesh();
}

/** The box of what is not black. */
Eigen::AlignedBox2i BoxOf(const Image<std::uint8_t>& picture)
{
  Eigen::AlignedBox2i box;
  for (int y = 0; y < picture.Height; ++y)
  {
    for (int x = 0; x < picture.Width; ++x)
    {
      if (picture(x, y, 0) || picture(x, y, 1) || picture(x, y, 2))
      {
        box.extend(Eigen::Vector2i(x, y));
      }
    }
  }
  return box.isEmpty() ? Eigen::AlignedBox2i(Eigen::Vector2i(0, 0),
                           Eigen::Vector2i(picture.Width - 1, picture.Height - 1))
                       : box;
}

/** Copies the part of a picture around a box's middle to a place in another; black beyond. */
void CopyPart(const Image<std::uint8_t>& from, const Eigen::AlignedBox2i& box, int top,
  const Eigen::Vector2i& size, Image<std::uint8_t>& to)
{
  const Eigen::Vector2i corner = (box.min() + box.max() - size) / 2;
  for (int y = 0; y < size.y(); ++y)
  {
    for (int x = 0; x < size.x(); ++x)
    {
      const int fromX = corner.x() + x;
      const int fromY = corner.y() + y;
      if (from.Ref().Contains(fromX, fromY))
      {
        std::copy_n(from.Ref().Pixel(fromX, fromY), 3, to.Ref().Pixel(x, top + y));
      }
    }
  }
}

/** The picture of a stage or the truth, black outside its mask. */
Image<std::uint8_t> Blackened(vtkImageData* image)
{
  const auto color = TopDownArray<const std::uint8_t>(image, arrays::Color, 3, "picture", true);
  const auto mask = TopDownArray<const std::uint8_t>(image, arrays::Mask, 1, "picture", true);
  Image<std::uint8_t> black(color.Width, color.Height, 3);
  for (int y = 0; y < color.Height; ++y)
  {
    for (int x = 0; x < color.Width; ++x)
    {
      if (mask(x, y) > 127)
      {
        std::copy_n(color.Pixel(x, y), 3, black.Ref().Pixel(x, y));
      }
    }
  }
  return black;
}

/** Where in the pictures the object is. */
struct Frames
{
  explicit Frames(const RunPageInput& input)
    : Initial(MeshOf(input, RowItems(input).front()))
    , Side(TurnedCamera(input.Novel, BoundingBox(this->Initial.Points).center(), SideAngleDeg))
    , Front(BoxOf(Blackened(input.Report->StageImages().front())))
    , Beside(BoxOf(ShadedMesh(this->Initial, this->Side)))
    , Size(this->Front.sizes().cwiseMax(this->Beside.sizes()) +
        Eigen::Vector2i::Constant(2 * MarginPx))
  {
  }

  TriangleMesh Initial;
  Camera Side; ///< from which the meshes are shown
  Eigen::AlignedBox2i Front;
  Eigen::AlignedBox2i Beside;
  Eigen::Vector2i Size; ///< of both
};

/** Figures 12 and 14: (a) visual hull, (b) after the outline, (c) after the others, (d) truth. */
std::vector<ReportPicture> StageFigure(const RunReport& report, const Frames& frames)
{
  std::vector<ReportPicture> pictures;
  const auto add = [&](const std::string& name, const std::string& caption, vtkImageData* image)
  {
    Image<std::uint8_t> part(frames.Size.x(), frames.Size.y(), 3);
    CopyPart(Blackened(image), frames.Front, 0, frames.Size, part);
    pictures.push_back(EmbedPicture(name, caption, part.Ref(), FigureSidePx));
  };
  const std::vector<std::pair<std::string, std::string>> names = { { "hull", "(a) visual hull" },
    { "outline", "(b) after refining outline points" },
    { "full", "(c) after refining non-outline points (final result)" } };
  for (const auto& [stage, caption] : names)
  {
    for (std::size_t i = 0; i < report.Stages().size(); ++i)
    {
      const auto& [name, scores] = report.Stages()[i];
      if (name == stage)
      {
        add(name, WithRms(caption, scores), report.StageImages()[i]);
      }
    }
  }
  if (report.TrueImage())
  {
    add("truth", "(d) ground truth", report.TrueImage());
  }
  return pictures;
}

/** Every picture: the novel view above, the mesh from beside below. */
std::vector<ReportPicture> Row(const RunPageInput& input, const Frames& frames)
{
  const std::vector<RowItem> items = RowItems(input);
  std::vector<ReportPicture> pictures(items.size());
  ParallelForEach(items.size(),
    [&](std::size_t i)
    {
      const RowItem& item = items[i];
      Image<std::uint8_t> both(frames.Size.x(), 2 * frames.Size.y(), 3);
      const Image<std::uint8_t> picture =
        item.Picture.empty() ? Blackened(input.Report->TrueImage()) : ReadColorFile(item.Picture);
      CopyPart(picture, frames.Front, 0, frames.Size, both);
      CopyPart(ShadedMesh(MeshOf(input, item), frames.Side), frames.Beside, frames.Size.y(),
        frames.Size, both);
      pictures[i] = EmbedPicture(item.Caption, item.Caption, both.Ref(), RowSidePx, 85);
    });
  return pictures;
}
}

void AddPaperFigures(ReportPage& page, const RunPageInput& input)
{
  const RunReport& report = *input.Report;
  page.BeginSection("paper", "In the form of the paper");
  page.AddText("The stages as in figures 12 and 14 of Chia, He and Lin (2013), and the RMS error "
               "after every iteration as in their tables 1 to 4.");
  const Frames frames(input);
  page.AddGallery(StageFigure(report, frames));
  for (const Stage step : { Stage::Outline, Stage::Full })
  {
    const ReportTable table = TimesTable(report, step);
    if (table.Columns.size() > 1)
    {
      page.AddTable(table);
    }
  }
  page.AddText("Iterations: the novel view above; below it the mesh, seen from 60 degrees beside. "
               "The mesh is refined for the novel view alone; insides of triangles are reddish.");
  page.AddGallery(Row(input, frames));
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/PaperFigures.h"

#include "ViewAccess.h"
#include "support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vtkNew.h>

#include <algorithm>

using namespace novelview;
using Eigen::Vector3d;
using support::TemporaryFolder;
using testing::HasSubstr;
using testing::Not;

namespace
{
/** A run on a triangle, of which the second iteration leaves only the points. */
struct TriangleRun
{
  TemporaryFolder Folder;
  vtkNew<vtkPolyData> Mesh;
  vtkNew<vtkPolyData> Points;
  vtkSmartPointer<vtkImageData> Picture = NewImage(41, 31);
  RunReport Report{ Folder.Path, nullptr };

  TriangleRun()
  {
    for (const char* each : { "stages", "iterations", "meshes/iterations" })
    {
      std::filesystem::create_directories(Folder.Path / each);
    }
    const auto color = AddTopDownArray<unsigned char>(Picture, arrays::Color, 3);
    const auto mask = AddTopDownArray<unsigned char>(Picture, arrays::Mask, 1);
    for (int y = 0; y < 31; ++y)
    {
      for (int x = 0; x < 41; ++x)
      {
        mask(x, y) = x > 10 && x < 30 ? 255 : 0;
        std::fill_n(color.Pixel(x, y), 3, 100);
      }
    }
    const TriangleMesh triangle{ { Vector3d(-1, 1, 10), Vector3d(1, 1, 10), Vector3d(0, -1, 10) },
      { Eigen::Vector3i(0, 1, 2) } };
    FromTriangleMesh(triangle, Mesh);
    FromTriangleMesh({ triangle.Points, {} }, Points);
    Report.AddStage("hull", Picture);
    Report.WriteMesh("power_crust", Mesh);
    Report.WriteMesh("hull", Mesh);
    for (int iteration = 0; iteration < 4; ++iteration)
    {
      IterationState state;
      state.Iteration = iteration;
      state.Mesh = iteration < 2 ? Mesh : Points;
      state.Image = Picture;
      Report.AddIteration(state, nullptr);
    }
  }

  std::string Page()
  {
    RunPageInput input;
    input.Folder = Folder.Path;
    input.Report = &Report;
    Eigen::Matrix3d k;
    k << 100, 0, 20, 0, 100, 15, 0, 0, 1;
    input.Novel = Camera{ k, Eigen::Matrix3d::Identity(), Vector3d::Zero() };
    input.Novel.Width = 41;
    input.Novel.Height = 31;
    ReportPage page("triangle", "");
    AddPaperFigures(page, input);
    return page.Html({});
  }
};
}

TEST(PaperFigures, ShowTheStartTheFirstIterationsAndTheLast)
{
  const std::string page = TriangleRun().Page();
  for (const char* shown :
    { "(a) visual hull", "initial mesh", "culled", "outline 1", "outline 3" })
  {
    EXPECT_THAT(page, HasSubstr(std::string(">") + shown + "<")) << "no RMS without a truth";
  }
  for (const char* absent : { ">outline 0<", "ground truth", "table-paper-outline" })
  {
    EXPECT_THAT(page, Not(HasSubstr(absent)));
  }
}

TEST(PaperFigures, AMeshWithoutFacesIsNoError)
{
  EXPECT_THAT(TriangleRun().Page(), HasSubstr(">outline 2<"));
}

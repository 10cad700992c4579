// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkPowerCrustMesher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCallbackCommand.h>
#include <vtkCleanPolyData.h>
#include <vtkDoubleArray.h>
#include <vtkFeatureEdges.h>
#include <vtkFloatArray.h>
#include <vtkHausdorffDistancePointSetFilter.h>
#include <vtkIdTypeArray.h>
#include <vtkLinearSubdivisionFilter.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>

namespace
{
/** A torus' points in a jittered order, with normals and a number per point. */
vtkSmartPointer<vtkPolyData> TorusSamples()
{
  auto samples = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkFloatArray> normals;
  normals->SetName("Normals");
  normals->SetNumberOfComponents(3);
  vtkNew<vtkDoubleArray> numbers;
  numbers->SetName("Number");
  const int rings = 60;
  const int sides = 24;
  for (int i = 0; i < rings; ++i)
  {
    for (int j = 0; j < sides; ++j)
    {
      // Half a step to and fro, so that no four samples share a circle by design.
      const double a = 2 * M_PI * (i + 0.3 * std::sin(7.0 * j + i)) / rings;
      const double b = 2 * M_PI * (j + 0.3 * std::cos(5.0 * i + j)) / sides;
      const double n[3] = { std::cos(b) * std::cos(a), std::cos(b) * std::sin(a), std::sin(b) };
      points->InsertNextPoint(std::cos(a) + 0.4 * n[0], std::sin(a) + 0.4 * n[1], 0.4 * n[2]);
      normals->InsertNextTuple(n);
      numbers->InsertNextValue(10.0 * static_cast<double>(numbers->GetNumberOfValues()));
    }
  }
  samples->SetPoints(points);
  samples->GetPointData()->SetNormals(normals);
  samples->GetPointData()->AddArray(numbers);
  return samples;
}

/** Keeps the text of the ErrorEvents of a filter. */
struct ErrorCatcher
{
  explicit ErrorCatcher(vtkObject* object)
  {
    vtkNew<vtkCallbackCommand> command;
    command->SetClientData(this);
    command->SetCallback([](vtkObject*, unsigned long, void* self, void* text)
      { static_cast<ErrorCatcher*>(self)->Text += static_cast<const char*>(text); });
    object->AddObserver(vtkCommand::ErrorEvent, command);
  }
  std::string Text;
};

vtkIdType CountBadEdges(vtkPolyData* mesh)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(mesh);
  edges->FeatureEdgesOff();
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->ManifoldEdgesOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}
}

TEST(PowerCrustMesher, DelaunayCrustKeepsSamplesAndTheirData)
{
  const vtkSmartPointer<vtkPolyData> samples = TorusSamples();
  vtkNew<vtkPowerCrustMesher> mesher;
  mesher->SetInputData(samples);
  mesher->Update();
  vtkPolyData* mesh = mesher->GetOutput();
  EXPECT_EQ(mesh->GetNumberOfPoints(), samples->GetNumberOfPoints());
  EXPECT_EQ(CountBadEdges(mesh), 0);
  // A torus: V - E + F = 0 and E = 3 F / 2 give F = 2 V.
  EXPECT_EQ(mesh->GetNumberOfPolys(), 2 * mesh->GetNumberOfPoints());
  auto* ids = vtkIdTypeArray::SafeDownCast(mesh->GetPointData()->GetArray("SampleIds"));
  vtkDataArray* numbers = mesh->GetPointData()->GetArray("Number");
  ASSERT_NE(ids, nullptr);
  ASSERT_NE(numbers, nullptr);
  ASSERT_NE(mesh->GetPointData()->GetNormals(), nullptr);
  for (vtkIdType ptId = 0; ptId < mesh->GetNumberOfPoints(); ++ptId)
  {
    double got[3];
    double expected[3];
    mesh->GetPoint(ptId, got);
    samples->GetPoint(ids->GetValue(ptId), expected);
    EXPECT_THAT(got, testing::ElementsAreArray(expected));
    EXPECT_EQ(numbers->GetTuple1(ptId), 10.0 * static_cast<double>(ids->GetValue(ptId)));
  }
}

TEST(PowerCrustMesher, PowerCrustIsTheSameSolid)
{
  vtkNew<vtkPowerCrustMesher> mesher;
  mesher->SetInputData(TorusSamples());
  mesher->SetOutputTypeToPowerCrust();
  mesher->Update();
  EXPECT_EQ(CountBadEdges(mesher->GetOutput()), 0);
  EXPECT_EQ(mesher->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  vtkNew<vtkMassProperties> properties;
  properties->SetInputData(mesher->GetOutput());
  properties->Update();
  // 2 pi^2 R r^2 = 3.158, less what the facets cut off (24 sides: 1 %; 60 rings: 0.2 %).
  EXPECT_NEAR(properties->GetVolume(), 2 * M_PI * M_PI * 0.16, 0.1);
}

TEST(PowerCrustMesher, MedialBallsOnPortOne)
{
  vtkNew<vtkPowerCrustMesher> mesher;
  mesher->SetInputData(TorusSamples());
  mesher->Update();
  vtkPolyData* balls = mesher->GetMedialBalls();
  ASSERT_GT(balls->GetNumberOfPoints(), 0);
  EXPECT_EQ(balls->GetNumberOfVerts(), balls->GetNumberOfPoints());
  auto* radii = vtkDoubleArray::SafeDownCast(balls->GetPointData()->GetArray("Radius"));
  auto* labels = vtkUnsignedCharArray::SafeDownCast(balls->GetPointData()->GetArray("Label"));
  ASSERT_NE(radii, nullptr);
  ASSERT_NE(labels, nullptr);
  int inner = 0;
  for (vtkIdType ptId = 0; ptId < balls->GetNumberOfPoints(); ++ptId)
  {
    double c[3];
    balls->GetPoint(ptId, c);
    const bool inTube = std::hypot(std::hypot(c[0], c[1]) - 1, c[2]) < 0.4;
    EXPECT_EQ(labels->GetValue(ptId), inTube ? 1 : 0);
    EXPECT_GT(radii->GetValue(ptId), 0);
    inner += inTube;
  }
  EXPECT_GT(inner, 0);
  EXPECT_LT(inner, balls->GetNumberOfPoints());
}

TEST(PowerCrustMesher, RunsTwiceWithTheSameResultAndLeavesTheInputAlone)
{
  const vtkSmartPointer<vtkPolyData> samples = TorusSamples();
  const vtkMTimeType before = samples->GetMTime();
  vtkNew<vtkPowerCrustMesher> mesher;
  mesher->SetInputData(samples);
  mesher->Update();
  vtkNew<vtkPolyData> first;
  first->DeepCopy(mesher->GetOutput());
  mesher->Modified();
  mesher->Update();
  vtkPolyData* second = mesher->GetOutput();
  ASSERT_EQ(first->GetNumberOfPolys(), second->GetNumberOfPolys());
  for (vtkIdType cellId = 0; cellId < first->GetNumberOfPolys(); ++cellId)
  {
    for (int k = 0; k < 3; ++k)
    {
      ASSERT_EQ(first->GetCell(cellId)->GetPointId(k), second->GetCell(cellId)->GetPointId(k));
    }
  }
  EXPECT_EQ(samples->GetMTime(), before);
}

TEST(PowerCrustMesher, BunnysCrustLiesOnTheBunny)
{
  const std::string file = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(file))
  {
    GTEST_SKIP() << "bunny.obj of glmark2-data is not installed";
  }
  vtkNew<vtkOBJReader> reader;
  reader->SetFileName(file.c_str());
  vtkNew<vtkCleanPolyData> truth;
  truth->SetInputConnection(reader->GetOutputPort());
  truth->Update();
  vtkNew<vtkPolyData> samples;
  samples->SetPoints(truth->GetOutput()->GetPoints());
  vtkNew<vtkPowerCrustMesher> mesher;
  mesher->SetInputData(samples);

  // Both have the same vertices, so what differs shows in the middle of edges.
  vtkNew<vtkLinearSubdivisionFilter> fineCrust;
  fineCrust->SetInputConnection(mesher->GetOutputPort());
  vtkNew<vtkLinearSubdivisionFilter> fineTruth;
  fineTruth->SetInputConnection(truth->GetOutputPort());
  vtkNew<vtkHausdorffDistancePointSetFilter> hausdorff;
  hausdorff->SetInputConnection(0, fineCrust->GetOutputPort());
  hausdorff->SetInputConnection(1, fineTruth->GetOutputPort());
  hausdorff->SetTargetDistanceMethodToPointToCell();
  hausdorff->Update();

  double longestEdge = 0;
  vtkPolyData* mesh = truth->GetOutput();
  for (vtkIdType cellId = 0; cellId < mesh->GetNumberOfCells(); ++cellId)
  {
    vtkIdType size = 0;
    const vtkIdType* ids = nullptr;
    mesh->GetCellPoints(cellId, size, ids);
    for (vtkIdType i = 0; i < size; ++i)
    {
      double a[3];
      double b[3];
      mesh->GetPoint(ids[i], a);
      mesh->GetPoint(ids[(i + 1) % size], b);
      longestEdge = std::max(longestEdge, std::sqrt(vtkMath::Distance2BetweenPoints(a, b)));
    }
  }
  // Edges that join the wrong samples bridge gaps; right ones stay within the sampling's spacing,
  // and well so: a point of an edge is no further from the surface than half of its length.
  EXPECT_GT(hausdorff->GetHausdorffDistance(), 0);
  EXPECT_LT(hausdorff->GetHausdorffDistance(), 0.5 * longestEdge);
}

TEST(PowerCrustMesher, NoPointsAreNoError)
{
  vtkNew<vtkPowerCrustMesher> mesher;
  ErrorCatcher errors(mesher);
  vtkNew<vtkPolyData> empty;
  mesher->SetInputData(empty);
  mesher->Update();
  EXPECT_EQ(mesher->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(mesher->GetMedialBalls()->GetNumberOfPoints(), 0);
  EXPECT_EQ(errors.Text, "");
}

TEST(PowerCrustMesher, BadInputIsOneErrorAndEmptyOutputs)
{
  vtkNew<vtkPowerCrustMesher> mesher;
  ErrorCatcher errors(mesher);
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0, 0, 0);
  points->InsertNextPoint(1, 0, 0);
  points->InsertNextPoint(0, 1, 0);
  vtkNew<vtkPolyData> three;
  three->SetPoints(points);
  mesher->SetInputData(three);
  mesher->Update();
  EXPECT_THAT(
    errors.Text, testing::HasSubstr("power crust: too few points (got 3, expected at least 4)"));
  EXPECT_EQ(mesher->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(mesher->GetMedialBalls()->GetNumberOfPoints(), 0);
}

TEST(PowerCrustMesher, PrintsEveryMember)
{
  vtkNew<vtkPowerCrustMesher> mesher;
  mesher->SetOutputType(77); // clamped
  EXPECT_EQ(mesher->GetOutputType(), vtkPowerCrustMesher::DelaunayCrust);
  mesher->SetMinimumComponentSamples(-5);
  std::ostringstream text;
  mesher->Print(text);
  EXPECT_THAT(text.str(), testing::HasSubstr("OutputType: DelaunayCrust"));
  EXPECT_THAT(text.str(), testing::HasSubstr("UseNormals: on"));
  EXPECT_THAT(text.str(), testing::HasSubstr("MinimumComponentSamples: 0"));
  EXPECT_THAT(text.str(), testing::HasSubstr("RecoverSamples: on"));
}

// SPDX-License-Identifier: GPL-3.0-or-later
/** Meshes, and their files as VTK writes them. */
#ifndef novelview_tests_MeshFiles_h
#define novelview_tests_MeshFiles_h

#include <gtest/gtest.h>

#include <vtkAlgorithm.h>
#include <vtkAppendPolyData.h>
#include <vtkCylinderSource.h>
#include <vtkLineSource.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkSphereSource.h>
#include <vtkStripper.h>
#include <vtkTriangleFilter.h>

#include <filesystem>
#include <functional>

namespace novelview::testing_support
{
/** Numbers without a short decimal, near and far from 1. */
inline vtkSmartPointer<vtkPolyData> Ball(int precision = vtkAlgorithm::SINGLE_PRECISION)
{
  vtkNew<vtkSphereSource> ball;
  ball->SetThetaResolution(9);
  ball->SetPhiResolution(7);
  ball->SetRadius(1.0 / 3);
  ball->SetCenter(1e-7, -123.4567, 1e5);
  ball->SetOutputPointsPrecision(precision);
  ball->Update();
  return ball->GetOutput();
}

/** Quadrangles, and two polygons of eleven corners. */
inline vtkSmartPointer<vtkPolyData> Tin()
{
  vtkNew<vtkCylinderSource> tin;
  tin->SetResolution(11);
  tin->SetCenter(0.1, 0.2, 0.3);
  tin->Update();
  return tin->GetOutput();
}

inline vtkSmartPointer<vtkPolyData> Triangulated(vtkPolyData* mesh)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(mesh);
  triangles->Update();
  return triangles->GetOutput();
}

/** Strips and polygons in one mesh, and lines, which are no faces. */
inline vtkSmartPointer<vtkPolyData> Strips()
{
  vtkNew<vtkStripper> strips;
  strips->SetInputData(Triangulated(Ball()));
  vtkNew<vtkLineSource> line;
  vtkNew<vtkAppendPolyData> all;
  all->AddInputConnection(strips->GetOutputPort());
  all->AddInputData(Tin());
  all->AddInputConnection(line->GetOutputPort());
  all->Update();
  return all->GetOutput();
}

template <class Writer>
void Write(
  vtkPolyData* mesh, const std::filesystem::path& file,
  const std::function<void(Writer*)>& configure = [](Writer*) {})
{
  vtkNew<Writer> writer;
  writer->SetFileName(file.c_str());
  writer->SetInputData(mesh);
  configure(writer);
  ASSERT_EQ(writer->Write(), 1) << file;
}
}

#endif

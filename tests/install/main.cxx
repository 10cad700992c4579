// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <vtkNew.h>
#include <vtkPinholeCamera.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkVisibilityCuller.h>

int main()
{
  const double cameraMatrix[9] = { 500, 0, 319.5, 0, 500, 239.5, 0, 0, 1 };
  vtkNew<vtkPinholeCamera> camera; // looks along +z, y down
  camera->SetCameraMatrix(cameraMatrix);
  camera->SetTranslation(0, 0, 5); // 5 units in front of the sphere
  camera->SetImageSize(640, 480);

  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkVisibilityCuller> culler;
  culler->SetInputConnection(sphere->GetOutputPort());
  culler->SetCamera(camera);
  culler->Update();
  const auto all = sphere->GetOutput()->GetNumberOfCells();
  const auto visible = culler->GetOutput()->GetNumberOfCells();
  std::cout << visible << " of " << all << " triangles are visible\n";
  return visible > 0 && visible < all ? 0 : 1; // less than half of the sphere, with its boundary
}

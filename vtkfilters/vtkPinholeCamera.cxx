// SPDX-License-Identifier: GPL-3.0-or-later
#include "vtkPinholeCamera.h"

#include "ViewAccess.h"

#include <vtkCamera.h>
#include <vtkMath.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkPinholeCamera);

namespace
{
void PrintArray(ostream& os, vtkIndent indent, const char* name, const double* values, int count)
{
  os << indent << name << ":";
  for (int i = 0; i < count; ++i)
  {
    os << " " << values[i];
  }
  os << "\n";
}
}

//------------------------------------------------------------------------------
vtkPinholeCamera::vtkPinholeCamera()
{
  vtkMath::Identity3x3(*reinterpret_cast<double(*)[3][3]>(this->CameraMatrix));
  vtkMath::Identity3x3(*reinterpret_cast<double(*)[3][3]>(this->Rotation));
}

//------------------------------------------------------------------------------
void vtkPinholeCamera::GetCentre(double centre[3])
{
  Eigen::Map<Eigen::Vector3d> out(centre);
  out = novelview::ToCamera(this).Centre();
}

//------------------------------------------------------------------------------
void vtkPinholeCamera::DeepCopy(vtkPinholeCamera* other)
{
  this->SetCameraMatrix(other->CameraMatrix);
  this->SetRotation(other->Rotation);
  this->SetTranslation(other->Translation);
  this->SetImageSize(other->ImageSize);
}

//------------------------------------------------------------------------------
void vtkPinholeCamera::CopyToVTKCamera(vtkCamera* camera, double nearDepth, double farDepth)
{
  const novelview::Camera source = novelview::ToCamera(this);
  const Eigen::Vector3d centre = source.Centre();
  const Eigen::Vector3d focus = centre + 0.5 * (nearDepth + farDepth) * source.OpticalAxis();
  const Eigen::Vector3d up = -source.R.row(1).transpose();
  camera->SetPosition(centre.data());
  camera->SetFocalPoint(focus.data());
  camera->SetViewUp(up.data());
  camera->SetClippingRange(nearDepth, farDepth);
  // Not used by the explicit projection below, but CopyFromVTKCamera and others read it.
  camera->SetUseHorizontalViewAngle(false);
  camera->SetViewAngle(
    vtkMath::DegreesFromRadians(2 * std::atan(source.Height / (2 * source.K(1, 1)))));

  // Pixel x maps to normalised device x = 2 (x + 0.5) / width - 1, and y is turned upside down;
  // OpenGL's camera looks along -z, hence the signs of the third column.
  const Eigen::Matrix3d& k = source.K;
  const double width = source.Width;
  const double height = source.Height;
  vtkNew<vtkMatrix4x4> projection;
  projection->Zero();
  projection->SetElement(0, 0, 2 * k(0, 0) / width);
  projection->SetElement(0, 1, -2 * k(0, 1) / width);
  projection->SetElement(0, 2, 1 - 2 * (k(0, 2) + 0.5) / width);
  projection->SetElement(1, 1, 2 * k(1, 1) / height);
  projection->SetElement(1, 2, 2 * (k(1, 2) + 0.5) / height - 1);
  projection->SetElement(2, 2, -(farDepth + nearDepth) / (farDepth - nearDepth));
  projection->SetElement(2, 3, -2 * farDepth * nearDepth / (farDepth - nearDepth));
  projection->SetElement(3, 2, -1);
  camera->SetExplicitProjectionTransformMatrix(projection);
  camera->UseExplicitProjectionTransformMatrixOn();
}

//------------------------------------------------------------------------------
void vtkPinholeCamera::CopyFromVTKCamera(vtkCamera* camera, int width, int height)
{
  const double size = camera->GetUseHorizontalViewAngle() ? width : height;
  const double focal = size / 2 / std::tan(vtkMath::RadiansFromDegrees(camera->GetViewAngle()) / 2);
  Eigen::Matrix3d k;
  k << focal, 0, (width - 1) / 2.0, 0, focal, (height - 1) / 2.0, 0, 0, 1;
  const Eigen::Vector3d centre(camera->GetPosition());
  const Eigen::Vector3d target(camera->GetFocalPoint());
  const Eigen::Vector3d up(camera->GetViewUp());
  novelview::FromCamera(novelview::LookAt(centre, target, up, k, width, height), this);
}

//------------------------------------------------------------------------------
void vtkPinholeCamera::LookAt(const double centre[3], const double target[3], const double up[3])
{
  using Vector = Eigen::Map<const Eigen::Vector3d>;
  const novelview::Camera camera = novelview::ToCamera(this);
  novelview::FromCamera(novelview::LookAt(Vector(centre), Vector(target), Vector(up), camera.K,
                          camera.Width, camera.Height),
    this);
}

//------------------------------------------------------------------------------
void vtkPinholeCamera::InterpolateOnOrbit(
  vtkPinholeCamera* from, vtkPinholeCamera* to, double fraction)
{
  if (!from || !to)
  {
    vtkErrorMacro(<< "orbit: one of the two cameras is missing");
    return;
  }
  novelview::FromCamera(
    novelview::InterpolateOnOrbit(novelview::ToCamera(from), novelview::ToCamera(to), fraction),
    this);
}

//------------------------------------------------------------------------------
void vtkPinholeCamera::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  PrintArray(os, indent, "CameraMatrix", this->CameraMatrix, 9);
  PrintArray(os, indent, "Rotation", this->Rotation, 9);
  PrintArray(os, indent, "Translation", this->Translation, 3);
  os << indent << "ImageSize: " << this->ImageSize[0] << " " << this->ImageSize[1] << "\n";
}

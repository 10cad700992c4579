// SPDX-License-Identifier: GPL-3.0-or-later
#include "drawing/SceneActors.h"

#include "ViewAccess.h"
#include "cameras/CameraUp.h"
#include "core/PrintableText.h"

#include <vtkActor.h>
#include <vtkAxesActor.h>
#include <vtkBillboardTextActor3D.h>
#include <vtkCamera.h>
#include <vtkCaptionActor2D.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace novelview
{
namespace
{
/** Apex and corners of the image plane: top left, top right, bottom right, bottom left. */
std::array<Eigen::Vector3d, 5> Pyramid(const Camera& camera, double depth)
{
  const double right = camera.Width - 0.5;
  const double bottom = camera.Height - 0.5;
  return { camera.Centre(), camera.Unproject({ -0.5, -0.5 }, depth),
    camera.Unproject({ right, -0.5 }, depth), camera.Unproject({ right, bottom }, depth),
    camera.Unproject({ -0.5, bottom }, depth) };
}

vtkSmartPointer<vtkActor> Lines(
  const std::array<Eigen::Vector3d, 5>& corners, const Colour& ink, double width)
{
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3d& corner : corners)
  {
    points->InsertNextPoint(corner.data());
  }
  vtkNew<vtkCellArray> lines;
  for (vtkIdType corner = 1; corner <= 4; ++corner)
  {
    lines->InsertNextCell({ vtkIdType(0), corner });
    lines->InsertNextCell({ corner, corner % 4 + 1 });
  }
  vtkNew<vtkPolyData> pyramid;
  pyramid->SetPoints(points);
  pyramid->SetLines(lines);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(pyramid);
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(ink[0], ink[1], ink[2]);
  actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  actor->GetProperty()->LightingOff();
  return actor;
}

/** The photograph on the image plane, the right way round from the camera. */
vtkSmartPointer<vtkActor> PictureActor(
  const std::array<Eigen::Vector3d, 5>& corners, vtkImageData* picture)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> places;
  places->SetNumberOfComponents(2);
  const double u[4] = { 0, 1, 1, 0 };
  const double v[4] = { 1, 1, 0, 0 }; // VTK's images begin at the bottom
  for (int corner = 0; corner < 4; ++corner)
  {
    points->InsertNextPoint(corners[corner + 1].data());
    places->InsertNextTuple2(u[corner], v[corner]);
  }
  vtkNew<vtkCellArray> faces;
  faces->InsertNextCell({ 0, 1, 2, 3 });
  vtkNew<vtkPolyData> plane;
  plane->SetPoints(points);
  plane->SetPolys(faces);
  plane->GetPointData()->SetTCoords(places);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(plane);
  vtkNew<vtkImageData> pixels;
  pixels->SetDimensions(picture->GetDimensions());
  pixels->GetPointData()->SetScalars(picture->GetPointData()->GetArray(arrays::Color));
  vtkNew<vtkTexture> texture;
  texture->SetInputData(pixels);
  texture->InterpolateOn();
  texture->MipmapOn();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->SetTexture(texture);
  actor->GetProperty()->LightingOff();
  return actor;
}

vtkSmartPointer<vtkBillboardTextActor3D> Label(
  const SceneCamera& camera, const Eigen::Vector3d& place, int sizePx)
{
  auto label = vtkSmartPointer<vtkBillboardTextActor3D>::New();
  label->SetInput(ValidUtf8(camera.Label).c_str());
  label->SetPosition(place.x(), place.y(), place.z());
  label->GetTextProperty()->SetFontSize(camera.Bold ? sizePx + 3 : sizePx);
  label->GetTextProperty()->SetBold(camera.Bold);
  label->GetTextProperty()->SetColor(camera.Ink.data());
  label->GetTextProperty()->SetJustificationToCentered();
  label->GetTextProperty()->SetVerticalJustificationToCentered();
  return label;
}
}

//------------------------------------------------------------------------------
void AddCameraToScene(vtkRenderer* renderer, const SceneCamera& camera, const FrustumStyle& style,
  std::vector<Eigen::Vector3d>* extent)
{
  Camera drawn = camera.Cam;
  const Eigen::Vector3d centre =
    style.Target + style.NearerBy * (camera.Cam.Centre() - style.Target);
  drawn.T = -(drawn.R * centre);
  const std::array<Eigen::Vector3d, 5> corners = Pyramid(drawn, style.Depth);
  renderer->AddActor(Lines(corners, camera.Ink, camera.Bold ? 3 : 1.5));
  if (camera.Picture)
  {
    renderer->AddActor(PictureActor(corners, camera.Picture));
  }
  const Eigen::Vector3d place = centre - 0.22 * style.Depth * drawn.OpticalAxis();
  if (!camera.Label.empty())
  {
    renderer->AddActor(Label(camera, place, style.LabelSizePx));
  }
  if (extent)
  {
    extent->insert(extent->end(), corners.begin(), corners.end());
    extent->push_back(centre - 0.4 * style.Depth * drawn.OpticalAxis()); // room for the label
  }
}

//------------------------------------------------------------------------------
void JoinLabels(std::vector<SceneCamera>& cameras, double distance)
{
  for (std::size_t later = 1; later < cameras.size(); ++later)
  {
    for (std::size_t earlier = 0; earlier < later; ++earlier)
    {
      SceneCamera& first = cameras[earlier];
      SceneCamera& second = cameras[later];
      const bool close = (first.Cam.Centre() - second.Cam.Centre()).norm() < distance;
      if (close && !first.Bold && !second.Bold && !first.Label.empty())
      {
        first.Label += ", " + second.Label;
        second.Label.clear();
        break;
      }
    }
  }
}

//------------------------------------------------------------------------------
Eigen::Vector3d UpOf(const std::vector<SceneCamera>& cameras)
{
  std::vector<Camera> plain;
  for (const SceneCamera& camera : cameras)
  {
    plain.push_back(camera.Cam);
  }
  return UpOfCameras(plain);
}

//------------------------------------------------------------------------------
void FitScene(vtkRenderer* renderer, const std::vector<Eigen::Vector3d>& points,
  const Eigen::Vector3d& towards, const Eigen::Vector3d& up, double aspect)
{
  const double halfAngle = 15 * EIGEN_PI / 180;
  const Eigen::Vector3d forward = towards.normalized();
  const Eigen::Vector3d right = forward.cross(up).normalized();
  const Eigen::Vector3d above = right.cross(forward);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : points)
  {
    box.extend(Eigen::Vector3d(right.dot(point), above.dot(point), forward.dot(point)));
  }
  // Perspective moves what is near away from the middle, so the best aim is found by a few rounds
  // of fitting and centring the projected extent.
  Eigen::Vector2d aim = box.center().head<2>();
  double distance = 0;
  for (int round = 0; round < 12; ++round)
  {
    distance = 0;
    for (const Eigen::Vector3d& point : points)
    {
      const double x = std::abs(right.dot(point) - aim.x()) / aspect;
      const double y = std::abs(above.dot(point) - aim.y());
      distance = std::max(distance, std::max(x, y) / std::tan(halfAngle) - forward.dot(point));
    }
    Eigen::AlignedBox2d seen;
    for (const Eigen::Vector3d& point : points)
    {
      const double depth = distance + forward.dot(point);
      seen.extend(Eigen::Vector2d(right.dot(point) - aim.x(), above.dot(point) - aim.y()) / depth);
    }
    aim += seen.center() * (distance + box.center().z());
  }
  distance *= 1.02;
  const Eigen::Vector3d focus = aim.x() * right + aim.y() * above + box.center().z() * forward;
  const Eigen::Vector3d eye = aim.x() * right + aim.y() * above - distance * forward;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetPosition(eye.data());
  camera->SetFocalPoint(focus.data());
  camera->SetViewUp(above.data());
  camera->SetViewAngle(30);
  renderer->ResetCameraClippingRange();
}

//------------------------------------------------------------------------------
void AddAxes(Canvas& canvas, const Box& box, vtkRenderer* scene, const Colour& background)
{
  vtkNew<vtkAxesActor> axes;
  for (vtkCaptionActor2D* caption : { axes->GetXAxisCaptionActor2D(),
         axes->GetYAxisCaptionActor2D(), axes->GetZAxisCaptionActor2D() })
  {
    caption->GetTextActor()->SetTextScaleModeToNone();
    caption->GetCaptionTextProperty()->SetFontSize(16);
    caption->GetCaptionTextProperty()->SetColor(colours::Text.data());
    caption->GetCaptionTextProperty()->ItalicOff();
    caption->GetCaptionTextProperty()->BoldOff();
    caption->GetCaptionTextProperty()->ShadowOff();
  }
  vtkRenderer* renderer = canvas.AddPanel(box, background);
  renderer->AddActor(axes);
  vtkCamera* camera = renderer->GetActiveCamera();
  const Eigen::Vector3d direction(scene->GetActiveCamera()->GetDirectionOfProjection());
  const Eigen::Vector3d eye = -direction;
  camera->SetFocalPoint(0, 0, 0);
  camera->SetPosition(eye.data());
  camera->SetViewUp(scene->GetActiveCamera()->GetViewUp());
  camera->ParallelProjectionOn();
  renderer->ResetCamera();
  camera->SetParallelScale(1.35);
  renderer->ResetCameraClippingRange();
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "cameras/CameraConvention.h"

#include "core/Error.h"
#include "images/ImageFile.h"

#include <Eigen/Dense>

namespace novelview
{
namespace
{
const Eigen::DiagonalMatrix<double, 3> OpenGlAxes(1, -1, -1);
const Eigen::DiagonalMatrix<double, 3> MirrorY(1, -1, 1);

/** The inverse of x -> R x + T. */
void Invert(Camera& camera, const std::string& where)
{
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(camera.R);
  if (!camera.R.allFinite() || !lu.isInvertible())
  {
    throw Error(where, "the pose's matrix is singular");
  }
  camera.R = lu.inverse().eval();
  camera.T = -(camera.R * camera.T);
}

/** y -> -y in the camera frame. */
void FlipLens(Lens& lens, const std::string& where)
{
  if (lens.Kind == Lens::Model::Fisheye)
  {
    return;
  }
  std::vector<double>& k = lens.Coefficients;
  for (const std::size_t odd : { 2, 10, 11 }) // p1, s3, s4 belong to y
  {
    if (odd < k.size())
    {
      k[odd] = -k[odd];
    }
  }
  if (Trimmed(lens).Coefficients.size() > 12)
  {
    throw Error(where, "a lens with a tilted sensor cannot be flipped");
  }
}

void FlipY(Photograph& photograph)
{
  Camera& camera = photograph.Cam;
  if (camera.Height == 0)
  {
    const PictureSize size = ReadPictureSize(photograph.File);
    camera.Width = size.Width;
    camera.Height = size.Height;
  }
  camera.R = (MirrorY * camera.R).eval();
  camera.T.y() = -camera.T.y();
  if (camera.R.determinant() < 0)
  {
    camera.R = (camera.R * MirrorY).eval();
  }
  camera.K(0, 1) = -camera.K(0, 1);
  camera.K(1, 2) = camera.Height - 1 - camera.K(1, 2);
  FlipLens(photograph.Distortion, photograph.Where);
}
}

CameraConvention ProjectConvention()
{
  return { "opencv", "world-to-camera", "row", 0.0, false, false };
}

CameraConvention Override(CameraConvention own, const CameraConvention& given)
{
  own.Axes = given.Axes == "format" ? own.Axes : given.Axes;
  own.Poses = given.Poses == "format" ? own.Poses : given.Poses;
  own.RotationOrder = given.RotationOrder == "format" ? own.RotationOrder : given.RotationOrder;
  own.PixelCentre = given.PixelCentre ? given.PixelCentre : own.PixelCentre;
  own.FlipY = given.FlipY ? !own.FlipY : own.FlipY;
  own.InvertMasks = given.InvertMasks ? !own.InvertMasks : own.InvertMasks;
  return own;
}

void ApplyConvention(const CameraConvention& convention, std::vector<Photograph>& photographs)
{
  for (Photograph& photograph : photographs)
  {
    Camera& camera = photograph.Cam;
    if (convention.RotationOrder == "column")
    {
      camera.R.transposeInPlace();
    }
    if (convention.Poses == "camera-to-world")
    {
      Invert(camera, photograph.Where);
    }
    if (convention.Axes == "opengl")
    {
      camera.R = (OpenGlAxes * camera.R).eval();
      camera.T = OpenGlAxes * camera.T;
    }
    camera.K.block<2, 1>(0, 2).array() -= *convention.PixelCentre;
    if (convention.FlipY)
    {
      FlipY(photograph);
    }
    photograph.InvertMask = convention.InvertMasks;
  }
}

Camera InConvention(const CameraConvention& convention, const Camera& camera)
{
  Camera stated = camera;
  stated.K.block<2, 1>(0, 2).array() += *convention.PixelCentre;
  if (convention.Axes == "opengl")
  {
    stated.R = (OpenGlAxes * stated.R).eval();
    stated.T = OpenGlAxes * stated.T;
  }
  if (convention.Poses == "camera-to-world")
  {
    Invert(stated, "camera");
  }
  if (convention.RotationOrder == "column")
  {
    stated.R.transposeInPlace();
  }
  return stated;
}
}

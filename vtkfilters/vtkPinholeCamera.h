// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkPinholeCamera
 * @brief A calibrated camera: K, R, t and the image size.
 *
 * Conventions: world unit = calibration unit; camera frame x right, y down, z forward;
 * x_cam = R x_world + t; pixel u ~ K x_cam with pixel centres on integers, (0,0) = centre of the
 * top-left pixel; depth = z in the camera frame. All matrices are row-major arrays of 9.
 *
 * K must be upper triangular with K[8] = 1 and positive focal lengths, R a rotation; the filters
 * that use the camera verify this and report violations.
 */
#ifndef vtkPinholeCamera_h
#define vtkPinholeCamera_h

#include "vtkNovelViewFiltersModule.h"
#include <vtkObject.h>

class vtkCamera;

class VTKNOVELVIEWFILTERS_EXPORT vtkPinholeCamera : public vtkObject
{
public:
  static vtkPinholeCamera* New();
  vtkTypeMacro(vtkPinholeCamera, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The camera matrix K, row-major, in pixels. Default: identity. */
  vtkSetVectorMacro(CameraMatrix, double, 9);
  vtkGetVectorMacro(CameraMatrix, double, 9);
  ///@}

  ///@{
  /** The rotation R from the world to the camera frame, row-major. Default: identity. */
  vtkSetVectorMacro(Rotation, double, 9);
  vtkGetVectorMacro(Rotation, double, 9);
  ///@}

  ///@{
  /** The translation t of x_cam = R x_world + t, in world units. Default: 0 0 0. */
  vtkSetVector3Macro(Translation, double);
  vtkGetVector3Macro(Translation, double);
  ///@}

  ///@{
  /** Width and height of the image in pixels. Default: 0 0, which is not an image. */
  vtkSetVector2Macro(ImageSize, int);
  vtkGetVector2Macro(ImageSize, int);
  ///@}

  /** The centre of projection C = -R' t. */
  void GetCentre(double centre[3]) VTK_SIZEHINT(3);

  /** Takes over everything from another camera. */
  void DeepCopy(vtkPinholeCamera* other);

  /**
   * Sets up a vtkCamera to see exactly what this one does (skew, off-centre principal point and
   * unequal focal lengths included), by an explicit projection matrix for the near and far planes
   * given as depths in world units, 0 < nearDepth < farDepth.
   */
  void CopyToVTKCamera(vtkCamera* camera, double nearDepth, double farDepth);

  /**
   * Takes over position, orientation and view angle of a (perspective) vtkCamera for an image of
   * this size. Square pixels, principal point in the middle of the frame.
   */
  void CopyFromVTKCamera(vtkCamera* camera, int width, int height);

  /**
   * Places the camera at `centre` to look at `target`, with `up` pointing up in the picture. Camera
   * matrix and image size stay. The points must differ, and not lie in a line along `up`.
   */
  void LookAt(const double centre[3], const double target[3], const double up[3]);

  /**
   * Becomes the camera a fraction of the way from one camera to another on their common orbit (the
   * screw motion between them), 0 to 1; values outside continue it. The camera matrix is
   * interpolated, the image size is that of `from`.
   */
  void InterpolateOnOrbit(vtkPinholeCamera* from, vtkPinholeCamera* to, double fraction);

protected:
  vtkPinholeCamera();
  ~vtkPinholeCamera() override = default;

  double CameraMatrix[9];
  double Rotation[9];
  double Translation[3] = { 0, 0, 0 };
  int ImageSize[2] = { 0, 0 };

private:
  vtkPinholeCamera(const vtkPinholeCamera&) = delete;
  void operator=(const vtkPinholeCamera&) = delete;
};

#endif

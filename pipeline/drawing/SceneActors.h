// SPDX-License-Identifier: GPL-3.0-or-later
// Private to the pipeline's images: the things that stand in a 3-D scene.
#ifndef novelview_SceneActors_h
#define novelview_SceneActors_h

#include "drawing/Canvas.h"
#include "geometry/Camera.h"

#include <vtkImageData.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <string>
#include <vector>

namespace novelview
{
/** A camera as it stands in a scene. */
struct SceneCamera
{
  Camera Cam;
  std::string Label;
  Colour Ink = colours::Reference;
  bool Bold = false;
  vtkSmartPointer<vtkImageData> Picture; ///< shown in the frustum (array Color); may be null
};

/** How cameras are drawn. */
struct FrustumStyle
{
  double Depth = 1;    ///< of the drawn pyramid, world units
  double NearerBy = 1; ///< centres are drawn at this fraction of their distance from Target
  Eigen::Vector3d Target = Eigen::Vector3d::Zero();
  int LabelSizePx = 15;
};

/** Pyramid, image and label of a camera. Its corners are appended to `extent`, if given. */
void AddCameraToScene(vtkRenderer* renderer, const SceneCamera& camera, const FrustumStyle& style,
  std::vector<Eigen::Vector3d>* extent = nullptr);

/**
 * Cameras that stand (nearly) at the same place, less than `distance` apart, get one label
 * together, "0, 10", instead of two on top of each other. Bold labels are left alone.
 */
void JoinLabels(std::vector<SceneCamera>& cameras, double distance);

/**
 * The direction that is up: in the cameras' images or, when those disagree (photographs may be
 * turned by a quarter), the axis that the cameras stand around.
 */
Eigen::Vector3d UpOf(const std::vector<SceneCamera>& cameras);

/**
 * Points the renderer's camera along `towards` so that all the points fill its panel, from the
 * least distance. `aspect` = width / height of the panel.
 */
void FitScene(vtkRenderer* renderer, const std::vector<Eigen::Vector3d>& points,
  const Eigen::Vector3d& towards, const Eigen::Vector3d& up, double aspect);

/** World axes (x red, y green, z blue) in a corner panel, seen as `scene` is seen. */
void AddAxes(Canvas& canvas, const Box& box, vtkRenderer* scene, const Colour& background);
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_SynthesisStages_h
#define novelview_SynthesisStages_h

#include "geometry/Camera.h"
#include "synthesis/Synthesis.h"
#include "vtkCameraRefiner.h"
#include "vtkDepthMapFuser.h"
#include "vtkPowerCrustMesher.h"
#include "vtkReferenceDepthEstimator.h"
#include "vtkSilhouetteReconciler.h"
#include "vtkSilhouetteRepairer.h"
#include "vtkViewDeformer.h"
#include "vtkViewDependentTextureMapper.h"
#include "vtkVisibilityCuller.h"
#include "vtkVisualHullSource.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkTrivialProducer.h>

class vtkAlgorithmOutput;

namespace novelview
{
/**
 * The filters of the method, set and connected as the options state; none has run. The texture
 * mapper lacks its mesh (port 0), and the occluders of port 2: which mesh is textured is the
 * caller's choice.
 */
struct SynthesisStages
{
  SynthesisStages(vtkMultiBlockDataSet* views, const SynthesisOptions& options);

  /** The novel camera, for every filter that depends on it. */
  void SetCamera(const Camera& camera);

  vtkNew<vtkTrivialProducer> Views;
  vtkNew<vtkSilhouetteReconciler> Reconciler;
  vtkNew<vtkVisualHullSource> HullSource;
  vtkNew<vtkSilhouetteRepairer> Repairer; ///< not connected unless silhouettes are to be repaired
  vtkNew<vtkPowerCrustMesher> Mesher;
  vtkNew<vtkReferenceDepthEstimator> DepthEstimator;
  vtkNew<vtkCameraRefiner> CameraRefiner; ///< not connected unless cameras are to be refined
  vtkNew<vtkVisibilityCuller> Culler;
  vtkSmartPointer<vtkViewDeformer> Outline;    ///< the paper's, or the one that follows depth maps
  vtkSmartPointer<vtkViewDeformer> NonOutline; ///< the same
  vtkNew<vtkViewDependentTextureMapper> Mapper;
  vtkNew<vtkDepthMapFuser> Fuser; ///< not connected

private:
  void ConnectViews(vtkAlgorithmOutput* silhouettes, bool useDepthMaps);
};
}

#endif

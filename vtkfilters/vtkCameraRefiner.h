// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkCameraRefiner
 * @brief Corrects the poses of the cameras by what the photographs show.
 *
 * A calibration that is off by a pixel blurs every stage after it: the hull loses the object's rim,
 * depth maps become noisy, and blended photographs do not lie on each other. Points of the surface
 * are searched in several photographs in two dimensions, not only along the epipolar lines, and the
 * poses adjusted to them (CameraRefinement.h). Only poses are refined: K and the world stay.
 *
 * Ports:
 *  - in 0: vtkMultiBlockDataSet, the views (see ViewAccess.h).
 *  - in 1: vtkMultiBlockDataSet, the same views in the same order with `Color`, `Mask`,
 *    `ContourDistance`, `Depth` and `Confidence` (vtkReferenceDepthEstimator).
 *  - out 0: the views of port 0, arrays shared, with the refined `Rotation` and `Translation`, and
 *    `CameraShift` (1 double): by how many pixels the refinement has moved the object in the image,
 *    RMS; 0 when it has been rejected.
 *
 * GetRefined() tells whether the cameras have been replaced. They are not when tracks that took no
 * part in the adjustment do not agree better with them; their bits then are those of the input.
 *
 * Differs from the paper: the whole stage is an addition; preset `paper` runs without it.
 *
 * Errors: fewer than two views, missing arrays, ports that do not have the same number of views.
 *
 * Reference: Triggs, McLauchlan, Hartley and Fitzgibbon, "Bundle adjustment - a modern synthesis",
 * 2000.
 */
#ifndef vtkCameraRefiner_h
#define vtkCameraRefiner_h

#include "FilterOptions.h"
#include "calibration/CameraRefinementOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkMultiBlockDataSetAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkCameraRefiner : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCameraRefiner* New();
  vtkTypeMacro(vtkCameraRefiner, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::CameraRefinementOptions);

  ///@{
  /**
   * The share by which the error of tracks that take no part has to fall. Default 0.05, range 0 to
   * 1.
   */
  vtkFilterOptionMacro(MinGain, double, MinGain);
  ///@}

  ///@{
  /** Results of the last run: whether the cameras were replaced, and the distance of tracks
   * that took no part from their epipolar lines before and after, pixels. */
  vtkGetMacro(Refined, bool);
  vtkGetMacro(ErrorBefore, double);
  vtkGetMacro(ErrorAfter, double);
  ///@}

protected:
  vtkCameraRefiner();
  ~vtkCameraRefiner() override = default;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool Refined = false;
  double ErrorBefore = 0;
  double ErrorAfter = 0;

private:
  vtkCameraRefiner(const vtkCameraRefiner&) = delete;
  void operator=(const vtkCameraRefiner&) = delete;
};

#endif

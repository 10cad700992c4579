// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkSilhouetteFilter
 * @brief Gives views the silhouettes that the filters need.
 *
 * Views that were not read by vtkViewsReader but put together from pixels and cameras lack at least
 * the distances to their silhouettes' contours. This filter adds what a view has not got: `Mask`,
 * taken from the photograph, whose background must then be plain (Silhouette.h); and
 * `ContourDistance`, computed from the mask (ContourDistance.h).
 *
 * Ports:
 *  - in 0: vtkMultiBlockDataSet, the views (see ViewAccess.h) with the camera's field arrays and
 *    `Mask` or `Color`.
 *  - out 0: the same with `Mask` and `ContourDistance` in every view. Other arrays pass through.
 *
 * What a user should know of a silhouette (the object leaves the frame, covers almost nothing or
 * almost everything) is a WarningEvent each.
 *
 * Errors: no views, a view without camera or with neither array, a silhouette that is empty or full.
 */
#ifndef vtkSilhouetteFilter_h
#define vtkSilhouetteFilter_h

#include "vtkNovelViewSynthesisModule.h"
#include <vtkMultiBlockDataSetAlgorithm.h>

class VTKNOVELVIEWSYNTHESIS_EXPORT vtkSilhouetteFilter : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkSilhouetteFilter* New();
  vtkTypeMacro(vtkSilhouetteFilter, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Compute both arrays even if they exist. Default off. */
  vtkSetMacro(Force, bool);
  vtkGetMacro(Force, bool);
  vtkBooleanMacro(Force, bool);
  ///@}

protected:
  vtkSilhouetteFilter() = default;
  ~vtkSilhouetteFilter() override = default;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool Force = false;

private:
  vtkSilhouetteFilter(const vtkSilhouetteFilter&) = delete;
  void operator=(const vtkSilhouetteFilter&) = delete;
};

#endif

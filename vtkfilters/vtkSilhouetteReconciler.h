// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkSilhouetteReconciler
 * @brief Enlarges silhouettes that are too small for the others.
 *
 * The visual hull believes every silhouette: one that a threshold has eaten into by two pixels takes
 * these two pixels off the object for good. The rays through the edge of each silhouette show
 * whether another one stands against them (SilhouetteConsistency.h); one that does far more often
 * than the rest is enlarged by as much as they require. Where all disagree by a little, as with
 * cameras that are off by a pixel, all are enlarged by a fraction of one.
 *
 * Ports:
 *  - in 0: vtkMultiBlockDataSet, the views (see ViewAccess.h) with `Mask` and `ContourDistance`.
 *  - out 0: the same views, arrays shared; where a silhouette was enlarged, `ContourDistance` is
 *    larger by the offset and `Mask` is what lies inside it now. Field array of each view:
 *    `ContourOffset` (1 double, pixels, 0 = as it came).
 *
 * Differs from the paper: the whole stage is an addition; preset `paper` runs without it.
 *
 * Errors: no views, missing arrays.
 */
#ifndef vtkSilhouetteReconciler_h
#define vtkSilhouetteReconciler_h

#include "FilterOptions.h"
#include "silhouettes/ConsistencyOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkMultiBlockDataSetAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkSilhouetteReconciler : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkSilhouetteReconciler* New();
  vtkTypeMacro(vtkSilhouetteReconciler, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::ConsistencyOptions);

  ///@{
  /** Smaller offsets are left alone, pixels. Default 0.5, range 0.25 to 100. */
  vtkFilterOptionMacro(MinOffset, double, MinPx);
  ///@}

  ///@{
  /** Part of the other views' edge rays a silhouette has to cut. Default 0.05, range 0 to 1. */
  vtkFilterOptionMacro(MinShare, double, MinShare);
  ///@}

protected:
  vtkSilhouetteReconciler() = default;
  ~vtkSilhouetteReconciler() override = default;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSilhouetteReconciler(const vtkSilhouetteReconciler&) = delete;
  void operator=(const vtkSilhouetteReconciler&) = delete;
};

#endif

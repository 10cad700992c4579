// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkWholeObjectRefiner
 * @brief Moves the points of a closed mesh onto the surface of fused depth maps, for no camera.
 *
 * Where the deformers refine what one novel camera sees, this filter moves every point of the mesh
 * along its normal to where the views' fused depth maps change from free to solid
 * (ModelRefinement.h).
 *
 * Ports:
 *  - in 0: vtkPolyData, closed mesh of triangles around the object, e.g. the power crust.
 *  - in 1: vtkMultiBlockDataSet, the views (ViewAccess.h) with `Color`, `Mask`, `ContourDistance`,
 *    `Depth` and `Confidence`.
 *  - out 0: vtkPolyData, the moved mesh: points and triangles in their order, no arrays.
 */
#ifndef vtkWholeObjectRefiner_h
#define vtkWholeObjectRefiner_h

#include "FilterOptions.h"
#include "fusion/DepthMapOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkWholeObjectRefiner : public vtkPolyDataAlgorithm
{
public:
  static vtkWholeObjectRefiner* New();
  vtkTypeMacro(vtkWholeObjectRefiner, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::DepthMapOptions);

  ///@{
  /**
   * Error of the depth maps in input pixel footprints, see vtkTsdfDeformer. 0 takes what
   * vtkReferenceDepthEstimator measured. Default 0, range 0 to 10.
   */
  vtkFilterOptionMacro(DepthNoise, double, DepthNoise);
  ///@}

protected:
  vtkWholeObjectRefiner();
  ~vtkWholeObjectRefiner() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkWholeObjectRefiner(const vtkWholeObjectRefiner&) = delete;
  void operator=(const vtkWholeObjectRefiner&) = delete;
};

#endif

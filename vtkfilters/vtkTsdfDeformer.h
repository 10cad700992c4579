// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkTsdfDeformer
 * @brief Base class of the deformers that follow depth maps.
 *
 * The depth maps of the views (arrays `Depth` and `Confidence`, as vtkReferenceDepthEstimator adds
 * them) are fused into a truncated signed distance (TsdfField.h). The distance to its zero crossing
 * takes the place of the photo-consistency in the energies that are minimised.
 *
 * Ports and arrays: see vtkViewDeformer; in 1 needs the arrays above, too.
 */
#ifndef vtkTsdfDeformer_h
#define vtkTsdfDeformer_h

#include "FilterOptions.h"
#include "fusion/DepthMapOptions.h"
#include "vtkViewDeformer.h"

class vtkDataObject;

namespace novelview
{
struct TsdfDeformationOptions;
}

class VTKNOVELVIEWFILTERS_EXPORT vtkTsdfDeformer : public vtkViewDeformer
{
public:
  vtkTypeMacro(vtkTsdfDeformer, vtkViewDeformer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::DepthMapOptions);

  ///@{
  /**
   * Error of the maps in input pixel footprints. The larger, the more smoothly and the less
   * closely they are followed (TsdfDeformation.h). 0 takes what vtkReferenceDepthEstimator
   * measured. Default 0, range 0 to 10.
   */
  vtkFilterOptionMacro(DepthNoise, double, DepthNoise);
  ///@}

protected:
  vtkTsdfDeformer() = default;
  ~vtkTsdfDeformer() override = default;

  /** How the depth maps of these views are followed. */
  novelview::TsdfDeformationOptions TsdfOptions(vtkDataObject* views);

private:
  vtkTsdfDeformer(const vtkTsdfDeformer&) = delete;
  void operator=(const vtkTsdfDeformer&) = delete;
};

#endif

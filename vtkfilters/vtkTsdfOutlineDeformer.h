// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkTsdfOutlineDeformer
 * @brief Moves the outline points of a mesh onto the silhouette that fused depth maps show.
 *
 * The sibling of vtkOutlineDeformer for views with depth maps. Outline points move, in the plane
 * through them parallel to the novel image plane, onto the contour of the silhouette that the fused
 * maps show to the novel camera, and the strip they sweep is cut away; each iteration lowers the
 * energy, the squared distance to that contour (TsdfDeformation.h). With
 * UseContourPrediction that contour is refined by the one interpolated from the photographs'
 * contours (ContourPrediction.h).
 *
 * Ports and arrays: see vtkTsdfDeformer. Out 0 contains only the triangles that face the novel
 * camera; added point arrays: `OutlineFlag` (uint8, 1 = outline point), `EnergyPhoto` (squared
 * distance by which a point lies outside the contour, pixels squared), `Energy` (the same),
 * `EnergyContour` and `EnergySmooth` (0).
 */
#ifndef vtkTsdfOutlineDeformer_h
#define vtkTsdfOutlineDeformer_h

#include "vtkTsdfDeformer.h"

class VTKNOVELVIEWFILTERS_EXPORT vtkTsdfOutlineDeformer : public vtkTsdfDeformer
{
public:
  static vtkTsdfOutlineDeformer* New();
  vtkTypeMacro(vtkTsdfOutlineDeformer, vtkTsdfDeformer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Weight of the label "object" against the photographs' votes when a ray is classified.
   * Larger values carve less. 0 takes the one that vtkReferenceDepthEstimator estimated for the
   * data set. Default 0, range 0 to 10.
   */
  vtkFilterOptionMacro(SilhouettePrior, double, SilhouettePrior);
  ///@}

  ///@{
  /** Refine the outline by the contour interpolated from the photographs' own. Default off. */
  vtkFilterSwitchMacro(UseContourPrediction, UsePrediction);
  ///@}

protected:
  vtkTsdfOutlineDeformer() = default;
  ~vtkTsdfOutlineDeformer() override = default;
  void Deform(const Work& work) override;
  const char* ContourArrayName() const override { return novelview::arrays::EnergyContour; }
  bool MovesOutline() const override { return true; }

private:
  vtkTsdfOutlineDeformer(const vtkTsdfOutlineDeformer&) = delete;
  void operator=(const vtkTsdfOutlineDeformer&) = delete;
};

#endif

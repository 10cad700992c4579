// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkTsdfNonOutlineDeformer
 * @brief Moves all points of a mesh along their viewing rays onto the surface of fused depth maps.
 *
 * The sibling of vtkNonOutlineDeformer for views with depth maps. Every point, outline points and
 * The sibling of vtkNonOutlineDeformer for views with depth maps. Every point, outline points and
 * invisible ones included, moves on the line through itself and the novel camera's centre; together
 * they minimise the squared distances to where the fused maps change from free to solid, and between
 * neighbours (TsdfDeformation.h).
 * Points that no photograph sees lie at the boundary of what is seen; unmoved they would be spikes.
 *
 * Ports and arrays: see vtkTsdfDeformer. Added point arrays: `EnergyPhoto` (squared
 * distance to the crossing), `EnergyHull` (to where the point started), `EnergySmooth`, `Energy`;
 * pixel footprints squared.
 */
#ifndef vtkTsdfNonOutlineDeformer_h
#define vtkTsdfNonOutlineDeformer_h

#include "vtkTsdfDeformer.h"

class VTKNOVELVIEWFILTERS_EXPORT vtkTsdfNonOutlineDeformer : public vtkTsdfDeformer
{
public:
  static vtkTsdfNonOutlineDeformer* New();
  vtkTypeMacro(vtkTsdfNonOutlineDeformer, vtkTsdfDeformer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkTsdfNonOutlineDeformer() = default;
  ~vtkTsdfNonOutlineDeformer() override = default;
  void Deform(const Work& work) override;
  const char* ContourArrayName() const override { return novelview::arrays::EnergyHull; }
  bool MovesOutline() const override { return false; }

private:
  vtkTsdfNonOutlineDeformer(const vtkTsdfNonOutlineDeformer&) = delete;
  void operator=(const vtkTsdfNonOutlineDeformer&) = delete;
};

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkOutlineDeformer
 * @brief Moves the outline points of a mesh in the novel image plane by photo-consistency.
 *
 * Outline points are the visible vertices whose projection lies on the contour of the model's own
 * silhouette in the novel view. In each iteration each of them searches, in the plane through it
 * parallel to the novel image plane, along the direction from its projection to the centroid of the
 * background pixels in the 5x5 window around it, both ways, for the candidate with the minimum
 *
 *     E   = E_s + ContourWeight E_c + SmoothWeight E_r                                    [1]
 *     E_s = mean over the key's neighbours of the normalised sum of squared differences   [2, 3]
 *     E_c = mean over the near views of min(d, sigma) / sigma                             [4]
 *     E_r = mean over the neighbouring outline points of |V_m . V_i|                      [5]
 *
 * and moves a part of the way towards it; the mesh behind the outline follows as a membrane. An
 * iteration that does not lower the mean energy is undone and repeated with half the moves; if this
 * does not help, the iterations end.
 *
 * Ports and arrays: see vtkViewDeformer. Out 0 contains only the triangles that face the novel
 * camera; added point arrays: `OutlineFlag` (uint8, 1 = outline point), `Energy`, `EnergyPhoto`,
 * `EnergyContour`, `EnergySmooth` (unweighted terms).
 *
 * Where the paper is silent: which photographs are compared (those that lie on the moving side of
 * the point and see it: the nearest to the novel view is the key); how the rest of the mesh
 * follows; when a minimum counts (it must be distinct, of a window that is not flat;
 * OutlineOptions).
 *
 * Differs from the paper: colours are compared less their windows' means, since flanking
 * photographs differ in brightness; a window with less than a quarter of its pixels in common takes
 * the worst photo energy; each point takes the median of its own and its outline neighbours' moves;
 * moves that would fold a triangle are shortened.
 *
 * Reference: Chia, He and Lin 2013, section 2.2.
 */
#ifndef vtkOutlineDeformer_h
#define vtkOutlineDeformer_h

#include "FilterOptions.h"
#include "deformation/DeformationOptions.h"
#include "vtkViewDeformer.h"

class VTKNOVELVIEWFILTERS_EXPORT vtkOutlineDeformer : public vtkViewDeformer
{
public:
  static vtkOutlineDeformer* New();
  vtkTypeMacro(vtkOutlineDeformer, vtkViewDeformer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel; NumberOfIterations replaces Iterations. */
  vtkFilterOptionsMacro(novelview::OutlineOptions);

  ///@{
  /** alpha of [1], weight of the contour energy. Default 0.3, range 0 to 100. */
  vtkFilterOptionMacro(ContourWeight, double, Alpha);
  ///@}

  ///@{
  /** beta of [1], weight of the smoothness energy. Default 0.3, range 0 to 100. */
  vtkFilterOptionMacro(SmoothWeight, double, Beta);
  ///@}

  ///@{
  /** Search range of a point to either side, novel pixels. Default 4, range 0.25 to 50. */
  vtkFilterOptionMacro(SearchRange, double, SearchPx);
  ///@}

  ///@{
  /** Radius of the photo-consistency windows, input pixels. Default 3 (7x7), range 1 to 7. */
  vtkFilterOptionMacro(WindowRadius, int, WindowRadius);
  ///@}

  ///@{
  /** sigma of the contour energy, input pixels. Default 4, range 0.5 to 100. */
  vtkFilterOptionMacro(ContourSigma, double, SigmaPx);
  ///@}

protected:
  vtkOutlineDeformer() = default;
  ~vtkOutlineDeformer() override = default;
  void Deform(const Work& work) override;
  const char* ContourArrayName() const override { return novelview::arrays::EnergyContour; }
  bool MovesOutline() const override { return true; }

private:
  vtkOutlineDeformer(const vtkOutlineDeformer&) = delete;
  void operator=(const vtkOutlineDeformer&) = delete;
};

#endif

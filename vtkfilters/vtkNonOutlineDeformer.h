// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkNonOutlineDeformer
 * @brief Moves the visible points that are no outline points along their viewing rays.
 *
 * Every visible point moves only on the line L through itself and the novel camera's centre, so
 * faces never cross in the novel view and concavities can open. In each iteration it moves to
 * the minimum, within SearchRange, of
 *
 *     E        = beta E_s + (1 - beta) E_vh + SmoothWeight E_r      [6]
 *     beta E_s = mean over the secondaries of w_k |P_sub,k - P|     [7]
 *     beta     = mean over the secondaries of w_k                   [8]
 *     E_vh     = distance from P to the visual hull                 [9]
 *     E_r      = |mean over the neighbours of (P_r,i - P) . V|      [10]
 *
 * with V the unit vector of L. P_sub,k is triangulated between the key image (the reference the
 * point's normal points to most directly among those that see it) and the most similar window in
 * secondary k, w_k that similarity. All lengths are divided by the pixel footprint, the world size
 * of one novel pixel at the point's depth.
 *
 * Ports and arrays: see vtkViewDeformer. The points moved are those with `Visible` 1 (or no such
 * array) and `OutlineFlag` 0 (or no such array). Added point arrays: `Energy`, `EnergyPhoto`
 * (beta E_s), `EnergyHull`, `EnergySmooth`.
 *
 * Differs from the paper: the normals that choose the keys are those of a point's neighbourhood;
 * windows are searched along the epipolar line of the key ray (MatchRange)
 * and a little across it rather than in a square; similarity is the normalised cross-correlation,
 * which, unlike a sum of squares, is 0 for unrelated windows; the distance to the hull is read from
 * the silhouette field (the least over the views of the distance to the silhouette's cone).
 *
 * Reference: Chia, He and Lin 2013, section 2.3.
 */
#ifndef vtkNonOutlineDeformer_h
#define vtkNonOutlineDeformer_h

#include "FilterOptions.h"
#include "deformation/DeformationOptions.h"
#include "vtkViewDeformer.h"

class VTKNOVELVIEWFILTERS_EXPORT vtkNonOutlineDeformer : public vtkViewDeformer
{
public:
  static vtkNonOutlineDeformer* New();
  vtkTypeMacro(vtkNonOutlineDeformer, vtkViewDeformer);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel; NumberOfIterations replaces Iterations. */
  vtkFilterOptionsMacro(novelview::NonOutlineOptions);

  ///@{
  /** alpha of [6], weight of the smoothness energy. Default 0.3, range 0 to 100. */
  vtkFilterOptionMacro(SmoothWeight, double, Alpha);
  ///@}

  ///@{
  /** How far a point may move in one iteration, pixel footprints. Default 12, range 0.25 to 100. */
  vtkFilterOptionMacro(SearchRange, double, SearchPx);
  ///@}

  ///@{
  /** Radius of the matching windows, input pixels. Default 5 (11x11), range 1 to 7. */
  vtkFilterOptionMacro(WindowRadius, int, WindowRadius);
  ///@}

  ///@{
  /** Search range along the epipolar line, each way, input pixels. Default 24, range 0 to 64. */
  vtkFilterOptionMacro(MatchRange, int, MatchRangePx);
  ///@}

protected:
  vtkNonOutlineDeformer() = default;
  ~vtkNonOutlineDeformer() override = default;
  void Deform(const Work& work) override;
  const char* ContourArrayName() const override { return novelview::arrays::EnergyHull; }
  bool MovesOutline() const override { return false; }

private:
  vtkNonOutlineDeformer(const vtkNonOutlineDeformer&) = delete;
  void operator=(const vtkNonOutlineDeformer&) = delete;
};

#endif

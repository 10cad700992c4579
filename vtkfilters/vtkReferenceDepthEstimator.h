// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkReferenceDepthEstimator
 * @brief A depth map in every photograph, for the deformers to find the surface by.
 *
 * The paper triangulates points between one key image and its neighbours for the vertices of one
 * mesh (equations 7 and 8). This stage does the same for every pixel with every photograph in turn
 * as the key, once per data set: first behind the hull's front at half resolution, then about the
 * fused surface of the maps around it at full resolution. The deformers fuse the maps on the lines
 * their points move on (TsdfField.h).
 *
 * Ports:
 *  - in 0: vtkMultiBlockDataSet, the views (see ViewAccess.h) with `Color`, `Mask`,
 *    `ContourDistance`.
 *  - in 1: vtkPolyData, a closed surface around the object: that of the hull (vtkVisualHullSource,
 *    port 1), or any mesh.
 *  - out 0: vtkMultiBlockDataSet, the same views (arrays shared) with two point arrays more:
 *      `Depth` (float, z in world units, 0 where there is no object),
 *      `Confidence` (float, 0 to 1);
 *    three field arrays of the whole: `DepthNoise` (1 double), by how many pixel footprints the maps
 *    of neighbouring photographs differ (MapComparison.h); `SilhouettePrior` (1 double), how much
 *    weight "object" needs at the outline so that the maps do not carve into the silhouettes
 *    (SilhouettePrior.h); and `SilhouetteSupport` (n x 4 double), points that the maps carve although
 *    a silhouette shows them, with how many pixels inside it (SilhouetteSupport.h); and one of each photograph, `ExposureGain` (1 double): how much brighter
 *    it is than the mean of all (MapComparison.h).
 *
 * Differs from the paper: the whole stage is an addition; preset `paper` runs without it.
 *
 * Errors: fewer than two views, missing arrays, cells that are not triangles.
 *
 * References: Chia, He and Lin 2013 [7, 8]; Hirschmueller, "Stereo processing by semiglobal
 * matching and mutual information", IEEE PAMI 30(2), 2008.
 */
#ifndef vtkReferenceDepthEstimator_h
#define vtkReferenceDepthEstimator_h

#include "FilterOptions.h"
#include "stereo/ReferenceDepthOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkMultiBlockDataSetAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkReferenceDepthEstimator : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkReferenceDepthEstimator* New();
  vtkTypeMacro(vtkReferenceDepthEstimator, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::ReferenceDepthOptions);

  ///@{
  /** Neighbouring photographs each is matched with. Default 4, range 1 to 16. */
  vtkFilterOptionMacro(Neighbours, int, Neighbours);
  ///@}

  ///@{
  /** How deep behind the hull's front is searched, pixel footprints. Default 150, range 4 to 1000. */
  vtkFilterOptionMacro(SearchDepth, double, CoarseLastPx);
  ///@}

  ///@{
  /** Radius of the matching windows, pixels. Default 2 (5x5), range 1 to 5. */
  vtkFilterOptionMacro(WindowRadius, int, Match.WindowRadius);
  ///@}

  ///@{
  /**
   * Share of the colour difference in the matching cost; the rest is correlation. Default 0.5,
   * range 0 to 1.
   */
  vtkFilterOptionMacro(ColorShare, double, Match.ColorShare);
  ///@}

protected:
  vtkReferenceDepthEstimator();
  ~vtkReferenceDepthEstimator() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkReferenceDepthEstimator(const vtkReferenceDepthEstimator&) = delete;
  void operator=(const vtkReferenceDepthEstimator&) = delete;
};

#endif

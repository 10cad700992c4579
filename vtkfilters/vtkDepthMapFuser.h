// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkDepthMapFuser
 * @brief Mesh of the whole object from the fused depth maps of all views, for no camera.
 *
 * Where the deformers refine what one novel camera sees, this filter makes a new mesh: the zero
 * crossing of the truncated signed distance field of all depth maps, sampled on a sparse lattice of
 * the photographs' resolution (FusedSurface.h). Parts are where photographs see them, and space is free
 * where they see through it, whatever the hull's topology. Where no photograph sees anything, the
 * hull stays.
 *
 * Ports:
 *  - in 0: vtkPolyData, points on the hull's surface, e.g. the power crust. Its cells do not matter.
 *  - in 1: vtkMultiBlockDataSet, the views (ViewAccess.h) with `Color`, `Mask`, `ContourDistance`,
 *    `Depth` and `Confidence`.
 *  - out 0: vtkPolyData, triangles, no arrays: closed, oriented outwards, manifold.
 *
 * Limits: creases are rounded by about the spacing. The hull bounds the mesh to within the spacing.
 *
 * Errors: missing arrays (naming the view), a hull without points or behind every camera, and when
 * the maps leave nothing of the object.
 *
 * Reference: Curless and Levoy, "A volumetric method for building complex models from range
 * images", SIGGRAPH 1996. Different are the sparse lattice without grid of the whole box, votes that
 * fade behind the surface, the silhouettes as bounds, and the smoothing where maps say little.
 */
#ifndef vtkDepthMapFuser_h
#define vtkDepthMapFuser_h

#include "FilterOptions.h"
#include "fusion/FusedSurfaceOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkDepthMapFuser : public vtkPolyDataAlgorithm
{
public:
  static vtkDepthMapFuser* New();
  vtkTypeMacro(vtkDepthMapFuser, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::FusedSurfaceOptions);

  ///@{
  /**
   * Distance between points of the mesh in pixels of the photographs at the object's middle.
   * Default 1.25, range 0.25 to 64.
   */
  vtkFilterOptionMacro(SampleSpacing, double, SpacingPx);
  ///@}

  ///@{
  /**
   * Error of the depth maps in input pixel footprints, see vtkTsdfDeformer. 0 takes what
   * vtkReferenceDepthEstimator measured. Default 0, range 0 to 10.
   */
  vtkFilterOptionMacro(DepthNoise, double, DepthNoise);
  ///@}

  ///@{
  /** Keep every connected component, not only the one with the most triangles. Default off. */
  vtkFilterSwitchMacro(KeepAllComponents, KeepAllComponents);
  ///@}

  ///@{
  /** What the last update left out: components, and their triangles. */
  vtkGetMacro(NumberOfDroppedComponents, int);
  vtkGetMacro(NumberOfDroppedTriangles, vtkIdType);
  ///@}

protected:
  vtkDepthMapFuser();
  ~vtkDepthMapFuser() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int NumberOfDroppedComponents = 0;
  vtkIdType NumberOfDroppedTriangles = 0;

private:
  vtkDepthMapFuser(const vtkDepthMapFuser&) = delete;
  void operator=(const vtkDepthMapFuser&) = delete;
};

#endif

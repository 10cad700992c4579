// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkVisualHullSource
 * @brief Surface samples of the visual hull of calibrated silhouettes.
 *
 * The visual hull is the set of points whose projection lies inside the silhouette of every view
 * that sees them. A view has no information outside its frame or behind its camera: it never
 * carves there. With d_v the signed contour distance of view v (pixels, positive inside), z_v the
 * depth and f_v the focal length, the hull is f >= 0 for
 *
 *     f(x) = min over the views that see x of  d_v(u_v(x)) z_v(x) / f_v.
 *
 * f is evaluated in an octree; each lattice cell with corners on both sides gives one sample, which
 * is root-found on f = 0, and those that crowd together (closer than 0.7 spacings, normals within 60
 * degrees) are thinned out.
 *
 * Ports:
 *  - in 0: vtkMultiBlockDataSet, the views (a vtkImageData block each, see ViewAccess.h) with point
 *    arrays `Mask` (uint8) and `ContourDistance` (float) and the camera's field arrays.
 *  - out 0: vtkPolyData, points (double) and point array `Normals` (float x 3, outward, unit). No
 *    cells.
 *  - out 1: vtkPolyData, triangles: the surface as the lattice connects all samples (surface nets),
 *    of before the thinning. Less accurate than the power crust, but available earlier: creases are cut by a
 *    fraction of the spacing, and it need not be a manifold.
 *
 * Limits: samples agree with the silhouettes to a small fraction of a pixel except where the frame
 * of a view cuts the hull; there they lie on the frame's border. Sharp creases are sampled, not
 * resolved.
 *
 * Errors: no views, missing arrays, an empty hull (naming the view that empties it), silhouettes
 * that do not bound the object when no box is given.
 *
 * Reference: Laurentini, "The visual hull concept for silhouette-based image understanding",
 * IEEE PAMI 16(2), 1994; the place of the stage: Chia, He and Lin 2013, section 2.1.
 */
#ifndef vtkVisualHullSource_h
#define vtkVisualHullSource_h

#include "FilterOptions.h"
#include "hull/VisualHullOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkVisualHullSource : public vtkPolyDataAlgorithm
{
public:
  static vtkVisualHullSource* New();
  vtkTypeMacro(vtkVisualHullSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::VisualHullOptions);

  ///@{
  /**
   * Distance between samples in pixels of the photographs at the object's middle. Default 2,
   * range 0.25 to 64.
   */
  vtkFilterOptionMacro(SampleSpacing, double, SpacingPx);
  ///@}

  ///@{
  /**
   * The box that bounds the hull, xmin xmax ymin ymax zmin zmax in world units: the hull is cut at
   * its faces. Default: 1 -1 1 -1 1 -1, an empty box: the box of SetOptions() if given, else
   * computed from the silhouettes.
   */
  vtkSetVector6Macro(SearchBounds, double);
  vtkGetVector6Macro(SearchBounds, double);
  ///@}

  ///@{
  /** Keep every connected component, not only the one with the most samples. Default off. */
  vtkFilterSwitchMacro(KeepAllComponents, KeepAllComponents);
  ///@}

  ///@{
  /** What the last update left out: components, and their samples. */
  vtkGetMacro(NumberOfDroppedComponents, int);
  vtkGetMacro(NumberOfDroppedSamples, vtkIdType);
  ///@}

  /** The sample spacing of the last update in world units. */
  vtkGetMacro(WorldSpacing, double);

  /** Whether the given box cut the hull of the last update. */
  vtkGetMacro(CutByBox, bool);

protected:
  vtkVisualHullSource();
  ~vtkVisualHullSource() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double SearchBounds[6] = { 1, -1, 1, -1, 1, -1 };
  int NumberOfDroppedComponents = 0;
  vtkIdType NumberOfDroppedSamples = 0;
  double WorldSpacing = 0;
  bool CutByBox = false;

private:
  vtkVisualHullSource(const vtkVisualHullSource&) = delete;
  void operator=(const vtkVisualHullSource&) = delete;
};

#endif

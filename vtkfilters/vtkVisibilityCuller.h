// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkVisibilityCuller
 * @brief Removes the triangles of a mesh that a camera cannot see.
 *
 * A triangle seen from the centre of projection spans an infinite triangular cone; a vertex in that
 * cone and behind the triangle is invisible. A triangle is removed only if its three vertices are
 * all invisible. "Behind" is deeper by more than Tolerance times the bounding box's diagonal.
 *
 * Ports:
 *  - in 0: vtkPolyData, triangles.
 *  - out 0: vtkPolyData, the triangles that remain with the points they use. Point data pass
 *    through; added: `Visible` (uint8, 1 = visible) and `OriginalPointIds` (id of the point in the
 *    input; -1 for the middle of an edge that was cut, which has the mean of its ends' floating-point
 *    data, the integers of one end, and is visible when both are).
 *  - out 1: vtkPolyData, the triangles removed and those that face away, likewise (without arrays):
 *    what still stands between the reference cameras and the object when a deformer has left the
 *    latter out, too.
 *
 * Differs from the paper: the same definition, found through a grid over the image plane instead of
 * comparing each vertex with every triangle. With MaximumEdgeLength what remains is made as fine as
 * this camera's pixels require, so that the mesh of the whole object need not be.
 *
 * Limits: a triangle with a corner behind the camera hides nothing.
 *
 * Errors: no camera, cells that are not triangles, a camera inside the (closed) mesh, a camera that
 * has nothing of the mesh in its frame.
 *
 * Reference: Chia, He and Lin 2013, section 2.1 and Figure 3.
 */
#ifndef vtkVisibilityCuller_h
#define vtkVisibilityCuller_h

#include "FilterOptions.h"
#include "geometry/VisibilityOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>

class vtkPinholeCamera;

class VTKNOVELVIEWFILTERS_EXPORT vtkVisibilityCuller : public vtkPolyDataAlgorithm
{
public:
  static vtkVisibilityCuller* New();
  vtkTypeMacro(vtkVisibilityCuller, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::VisibilityOptions);

  ///@{
  /** The novel camera. Default: none, which is an error on update. */
  void SetCamera(vtkPinholeCamera* camera);
  vtkPinholeCamera* GetCamera();
  ///@}

  ///@{
  /** How much deeper "behind" is, in diagonals of the bounding box. Default 1e-6, range 0 to 0.1. */
  vtkFilterOptionMacro(Tolerance, double, Tolerance);
  ///@}

  ///@{
  /**
   * Edges that remain and are longer than this in the camera's image, pixels, are split once at
   * their midpoints; 0 splits none. Default 0, range 0 to 1000.
   */
  vtkFilterOptionMacro(MaximumEdgeLength, double, LongestEdgePx);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkVisibilityCuller();
  ~vtkVisibilityCuller() override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  vtkSmartPointer<vtkPinholeCamera> Camera;

private:
  vtkVisibilityCuller(const vtkVisibilityCuller&) = delete;
  void operator=(const vtkVisibilityCuller&) = delete;
};

#endif

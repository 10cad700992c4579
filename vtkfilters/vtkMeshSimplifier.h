// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkMeshSimplifier
 * @brief Reduces a closed mesh to a number of triangles, and measures what that changed.
 *
 * Edges are collapsed, those first whose planes lose least (MeshSimplification.h). The result is a
 * manifold of the same genus. Without a number of triangles the mesh passes as it is, and is only
 * examined.
 *
 * Ports:
 *  - in 0: vtkPolyData, triangles of a closed manifold, oriented alike.
 *  - out 0: vtkPolyData, triangles; no arrays if simplified.
 *
 * Limits: creases and thin parts are kept only as far as their planes tell. Collapses may make
 * triangles intersect; they are counted.
 *
 * Errors: a mesh that is not a manifold.
 *
 * Reference: Garland and Heckbert, "Surface simplification using quadric error metrics", SIGGRAPH
 * 1997, as implemented by CGAL.
 */
#ifndef vtkMeshSimplifier_h
#define vtkMeshSimplifier_h

#include "FilterOptions.h"
#include "geometry/MeshSimplificationOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkMeshSimplifier : public vtkPolyDataAlgorithm
{
public:
  static vtkMeshSimplifier* New();
  vtkTypeMacro(vtkMeshSimplifier, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::MeshSimplificationOptions);

  ///@{
  /** Triangles to leave, at most; 0 leaves all. Default 0, range 0 to 2147483647. */
  vtkFilterOptionMacro(NumberOfTriangles, int, Triangles);
  ///@}

  ///@{
  /** Of the last update: the largest distance of the input's points from the output, world units. */
  vtkGetMacro(MaximumDistance, double);
  ///@}

  ///@{
  /** Of the last output: pairs of triangles that intersect, and the sum of its components' genera. */
  vtkGetMacro(NumberOfSelfIntersections, vtkIdType);
  vtkGetMacro(Genus, int);
  ///@}

protected:
  vtkMeshSimplifier() = default;
  ~vtkMeshSimplifier() override = default;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  double MaximumDistance = 0;
  vtkIdType NumberOfSelfIntersections = 0;
  int Genus = 0;

private:
  vtkMeshSimplifier(const vtkMeshSimplifier&) = delete;
  void operator=(const vtkMeshSimplifier&) = delete;
};

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkPowerCrustMesher
 * @brief A closed, oriented, manifold surface of points sampled on an object.
 *
 * Input 0: vtkPolyData, the samples (n points; cells are ignored). Optional point normals, outward,
 * of any length, help to distinguish inside from outside where the sampling is sparse.
 *
 * Output 0: vtkPolyData, triangles counter-clockwise seen from outside.
 *   DelaunayCrust: the points are samples, and carry the input's point data (Normals, ...).
 *   PowerCrust: the points are vertices of the power diagram, without point data.
 * Output 1: vtkPolyData, the polar (medial) balls: a point with a vertex cell for each centre.
 *
 * Output arrays, point data:
 *   output 0, DelaunayCrust  SampleIds        vtkIdType   the input point it is
 *   output 1                 Radius           double      world units
 *                            Label            uint8       1 = inner, 0 = outer ball
 *
 * The power crust: the Delaunay triangulation of the samples and eight far corners; the poles, per
 * sample the farthest vertex of its Voronoi cell and the farthest on the other side; poles labelled
 * inner or outer from the far corners on, most certain first: deeply intersecting balls alike, the
 * two poles of a sample unlike. PowerCrust is the faces between inner and outer cells of the polar
 * balls' power diagram. DelaunayCrust is the boundary of the Delaunay tetrahedra that are inside:
 * those of poles by their label, others by the ball they agree with best.
 *
 * The surface is always closed, oriented and edge- and vertex-manifold. PowerCrust is by
 * construction. DelaunayCrust is repaired: tetrahedra around irregular samples are relabelled, on
 * the side where that costs less volume; what remains is cut apart, by doubling points and, rarely,
 * by adding the midpoint of an edge.
 *
 * Differs from the paper: labels spread between the poles of neighbouring samples, not of
 * neighbouring power cells, and a pole sums its evidence; cospherical poles are merged; normals can
 * help; no ball is discarded for noise; the samples can be the surface's points (DelaunayCrust).
 *
 * Limits: noise (standard deviation) must stay below about half the sampling distance; samples
 * deep under the surface are left out; duplicates count once. The balls of samples on the convex
 * hull that reach outwards without end are not listed.
 *
 * Errors: less than four points, points not finite, in one plane, or enclosing nothing. No points
 * at all give an empty output.
 *
 * Reference: Amenta, Choi, Kolluri, "The power crust", ACM Symposium on Solid Modeling 2001.
 */
#ifndef vtkPowerCrustMesher_h
#define vtkPowerCrustMesher_h

#include "FilterOptions.h"
#include "crust/PowerCrustOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkPowerCrustMesher : public vtkPolyDataAlgorithm
{
public:
  static vtkPowerCrustMesher* New();
  vtkTypeMacro(vtkPowerCrustMesher, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel; OutputType replaces Output. */
  vtkFilterOptionsMacro(novelview::PowerCrustOptions);

  enum OutputTypes
  {
    PowerCrust = 0,
    DelaunayCrust = 1
  };

  ///@{
  /** Which surface output 0 is. Default: DelaunayCrust. */
  vtkSetClampMacro(OutputType, int, PowerCrust, DelaunayCrust);
  vtkGetMacro(OutputType, int);
  void SetOutputTypeToPowerCrust() { this->SetOutputType(PowerCrust); }
  void SetOutputTypeToDelaunayCrust() { this->SetOutputType(DelaunayCrust); }
  ///@}

  ///@{
  /** Whether the input's point normals, if there are any, take part. Default on. */
  vtkSetMacro(UseNormals, bool);
  vtkGetMacro(UseNormals, bool);
  vtkBooleanMacro(UseNormals, bool);
  ///@}

  ///@{
  /**
   * DelaunayCrust only: pieces and cavities with fewer samples than this are dropped as noise; the
   * largest piece stays. 0 keeps all. Default 20, range 0 to 2147483647.
   */
  vtkFilterOptionMacro(MinimumComponentSamples, int, MinimumComponentSamples);
  ///@}

  ///@{
  /** DelaunayCrust only: bring samples just off the surface onto it. Default on. */
  vtkFilterSwitchMacro(RecoverSamples, RecoverSamples);
  ///@}

  /** The polar balls, output 1. */
  vtkPolyData* GetMedialBalls();

protected:
  vtkPowerCrustMesher();
  ~vtkPowerCrustMesher() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int OutputType = DelaunayCrust;
  bool UseNormals = true;

private:
  vtkPowerCrustMesher(const vtkPowerCrustMesher&) = delete;
  void operator=(const vtkPowerCrustMesher&) = delete;
};

#endif

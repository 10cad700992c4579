// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * The data model of the views, and the only file that depends on its layout.
 *
 * Views are one vtkMultiBlockDataSet with a vtkImageData block per photograph (origin 0, spacing 1,
 * VTK's bottom-up rows; block name = the photograph's name):
 *
 *   point data  Color            uint8 x 3   RGB
 *               Mask             uint8       above 127 = object
 *               ContourDistance  float       signed distance to the silhouette's contour, pixels,
 *                                            positive inside
 *               Depth            float       optional: depth in world units, 0 = unknown
 *               Confidence       float       optional: of the depth, 0 to 1
 *   field data  CameraMatrix (9, row-major), Rotation (9, row-major), Translation (3)
 *               ExposureGain     double      optional: brightness against the mean of all
 *               ContourOffset    double      optional: by how many pixels the silhouette has been
 *                                            enlarged
 *               AddedPixels      double      optional: so many pixels have been added to the
 *                                            silhouette
 *               CameraShift      double      optional: by how many pixels the refinement of the
 *                                            cameras has moved the object in the image
 *
 * and, once there are depth maps, three arrays in the field data of the whole: DepthNoise,
 * SilhouettePrior and SilhouetteSupport (see vtkReferenceDepthEstimator).
 *
 * Functions throw novelview::Error.
 */
#ifndef novelview_ViewAccess_h
#define novelview_ViewAccess_h

#include "ArrayNames.h"
#include "fusion/SilhouetteSupport.h"
#include "geometry/TriangleMesh.h"
#include "geometry/View.h"
#include "vtkNovelViewFiltersModule.h"

#include <vtkSmartPointer.h>

#include <string>
#include <vector>

class vtkDataObject;
class vtkFloatArray;
class vtkImageData;
class vtkMultiBlockDataSet;
class vtkPinholeCamera;
class vtkPolyData;

namespace novelview
{
/** An image block of this size without arrays. */
VTKNOVELVIEWFILTERS_EXPORT vtkSmartPointer<vtkImageData> NewImage(int width, int height);

/**
 * Adds (or replaces) a point array of `channels` components and returns it as rows from the top.
 * Together with TopDownArray this is the bottom-up flip of the project: VTK's first row is the
 * bottom one, so the reference starts at the last row and has a negative stride.
 */
template <class T>
ImageRef<T> AddTopDownArray(vtkImageData* image, const char* name, int channels);

/**
 * A point array as rows from the top; empty when the image has no such array and `required` is
 * false. Throws when the array has another type or number of components.
 */
template <class T>
ImageRef<T> TopDownArray(
  vtkImageData* image, const char* name, int channels, const std::string& where, bool required);

/** Adds (or replaces) a point array with the pixels of an image of the same size. */
template <class T>
void CopyToArray(const Image<T>& from, const char* name, vtkImageData* to);

/** Writes a camera into the field arrays of an image block, or reads it back. */
VTKNOVELVIEWFILTERS_EXPORT void AttachCamera(vtkImageData* image, const Camera& camera);
VTKNOVELVIEWFILTERS_EXPORT Camera AttachedCamera(vtkImageData* image, const std::string& where);

/** A number in the field data of an image or of all views; `otherwise` when there is none. */
VTKNOVELVIEWFILTERS_EXPORT void AttachNumber(vtkDataObject* to, const char* name, double value);
VTKNOVELVIEWFILTERS_EXPORT double AttachedNumber(
  vtkDataObject* to, const char* name, double otherwise);

/** The noise of the views' depth maps in pixels: `given` if positive, else what is attached, or 0. */
VTKNOVELVIEWFILTERS_EXPORT double DepthNoiseOf(vtkDataObject* views, double given = 0);

/** A table in the field data, row by row; empty when there is none. */
VTKNOVELVIEWFILTERS_EXPORT void AttachTable(
  vtkDataObject* to, const char* name, const std::vector<double>& values, int columns);
/** Throws when the table has another number of columns. */
VTKNOVELVIEWFILTERS_EXPORT std::vector<double> AttachedTable(
  vtkDataObject* to, const char* name, int columns);

/** The points of FindSilhouetteSupport() in the field data of all views. */
VTKNOVELVIEWFILTERS_EXPORT void AttachSupport(
  vtkDataObject* views, const std::vector<SupportPoint>& points);
VTKNOVELVIEWFILTERS_EXPORT std::vector<SupportPoint> AttachedSupport(vtkDataObject* views);

/** Appends a block. */
VTKNOVELVIEWFILTERS_EXPORT void AppendView(
  vtkMultiBlockDataSet* views, const std::string& name, vtkImageData* image, const Camera& camera);

/** The name and image of a block. Throws when it is not an image. */
VTKNOVELVIEWFILTERS_EXPORT std::string ViewName(vtkMultiBlockDataSet* views, unsigned int viewId);
VTKNOVELVIEWFILTERS_EXPORT vtkImageData* ViewImage(
  vtkMultiBlockDataSet* views, unsigned int viewId);

/** Which optional things a reader of views needs. */
struct ViewNeeds
{
  bool Color = false;
  bool Mask = true;
  bool ContourDistance = false;
};

/**
 * All views with their pixels borrowed from the blocks, every camera validated, at least
 * `atLeast` of them.
 */
VTKNOVELVIEWFILTERS_EXPORT std::vector<View> ReadViews(
  vtkMultiBlockDataSet* views, const ViewNeeds& needs, std::size_t atLeast = 1);

/** ReadViews() with Color, Mask and ContourDistance: what stages that look at pixels need. */
VTKNOVELVIEWFILTERS_EXPORT std::vector<View> ReadColouredViews(
  vtkMultiBlockDataSet* views, std::size_t atLeast = 1);

VTKNOVELVIEWFILTERS_EXPORT Camera ToCamera(vtkPinholeCamera* camera);
VTKNOVELVIEWFILTERS_EXPORT void FromCamera(const Camera& camera, vtkPinholeCamera* out);
VTKNOVELVIEWFILTERS_EXPORT vtkSmartPointer<vtkPinholeCamera> NewPinholeCamera(const Camera& camera);

/** Triangles of a vtkPolyData; throws when a cell is no triangle or a coordinate is not finite. */
VTKNOVELVIEWFILTERS_EXPORT TriangleMesh ToTriangleMesh(vtkPolyData* poly, const std::string& where);
/** Points (double) and triangles into a vtkPolyData; attributes are left alone. */
VTKNOVELVIEWFILTERS_EXPORT void FromTriangleMesh(const TriangleMesh& mesh, vtkPolyData* out);
/** A uint8 point array as one value per point; `otherwise` for all when there is none. */
VTKNOVELVIEWFILTERS_EXPORT std::vector<std::uint8_t> PointFlags(
  vtkPolyData* poly, const char* name, std::uint8_t otherwise);
/** A `Normals` array (float x 3). */
VTKNOVELVIEWFILTERS_EXPORT vtkSmartPointer<vtkFloatArray> NewNormals(
  const std::vector<Eigen::Vector3d>& normals);
}

#endif

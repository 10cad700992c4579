// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkViewDependentTextureMapper
 * @brief The image of a mesh in a camera, coloured from calibrated photographs.
 *
 * The mesh lookup table (the mesh rasterised into the camera, in software) gives every pixel its
 * surface point V. Its colour is
 *
 *     sum_c W_c^m I_c(project(V)) / sum_c W_c^m
 *
 * over the References photographs nearest in viewing direction that see V, W_c being the cosine
 * between the novel and the reference viewing ray, I_c bilinear. A photograph sees V when V is not
 * deeper than the model there, and V projects inside its silhouette, away from the border.
 *
 * Ports:
 *  - in 0: vtkPolyData, triangles.
 *  - in 1: vtkMultiBlockDataSet, the views (see ViewAccess.h) with `Color`, `Mask`,
 *    `ContourDistance`, and `Depth` when UseDepthMaps is on; field array `ExposureGain`.
 *  - in 2 (optional): vtkPolyData, triangles that also stand between photographs and mesh, such as
 *    those a vtkVisibilityCuller removed.
 *  - out 0: vtkImageData of the camera's size (bottom-up rows) with point arrays
 *      `Color` (uint8 x 3), black outside the mask (but see SoftBoundary);
 *      `Mask` (uint8, 255 = object);
 *      `Depth` (float, world units, 0 outside);
 *      `CellId` (int, triangle of the mesh, -1 outside);
 *      `Seen` (uint8, 1 = at least one photograph sees the point; 0 with Mask 255 = filled from
 *      the surroundings).
 *
 * Differs from the paper: photographs that do not see V are left out; the weight falls towards the
 * silhouette's border (FeatherWidth); boundary pixels are antialiased against black (BoundarySamples; 1 is
 * the paper's, as is SoftBoundary off); occlusion may be soft and tested against the views' own depth maps
 * (OcclusionSoftness, UseDepthMaps; off is the paper's); photographs of different exposure are
 * brought to their mean (UseExposureGains; off is the paper's).
 *
 * Errors: no camera, cells that are not triangles, missing arrays.
 *
 * Reference: Chia, He and Lin 2013, section 3 and Figures 9 and 10.
 */
#ifndef vtkViewDependentTextureMapper_h
#define vtkViewDependentTextureMapper_h

#include "FilterOptions.h"
#include "texture/TextureOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkImageAlgorithm.h>
#include <vtkSmartPointer.h>

class vtkPinholeCamera;

class VTKNOVELVIEWFILTERS_EXPORT vtkViewDependentTextureMapper : public vtkImageAlgorithm
{
public:
  static vtkViewDependentTextureMapper* New();
  vtkTypeMacro(vtkViewDependentTextureMapper, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::TextureOptions);

  ///@{
  /** The novel camera. Default: none, which is an error on update. */
  void SetCamera(vtkPinholeCamera* camera);
  vtkPinholeCamera* GetCamera();
  ///@}

  ///@{
  /** Photographs blended per pixel. Default 3, range 1 to 64. */
  vtkFilterOptionMacro(References, int, References);
  ///@}

  ///@{
  /** The exponent m of the weights. Default 8, range 0 to 64. */
  vtkFilterOptionMacro(Power, double, Power);
  ///@}

  ///@{
  /**
   * Width over which a photograph's weight grows from its silhouette's border inwards, pixels.
   * Default 2, range 0.01 to 100.
   */
  vtkFilterOptionMacro(FeatherWidth, double, FeatherPx);
  ///@}

  ///@{
  /**
   * Softness of the occlusion test in pixel footprints: a point z behind the model counts
   * exp(-(z / softness)^2). 0 tests hard at 1.5 footprints. A test by depth maps is softer, to 10
   * footprints, when three times their `DepthNoise` is more. Default 0, range 0 to 100.
   */
  vtkFilterOptionMacro(OcclusionSoftness, double, OcclusionPx);
  ///@}

  ///@{
  /** Test occlusion against the views' `Depth` arrays, if present. Default off. */
  vtkFilterSwitchMacro(UseDepthMaps, UseDepthMaps);
  ///@}

  ///@{
  /**
   * Pixels whose photographs look from further aside than the second nearest one by this angle take
   * their level from the surroundings (FarPixels.h); 0 = none, degrees. Default 0, range 0 to 90.
   */
  vtkFilterOptionMacro(FarAngle, double, FarDeg);
  ///@}

  ///@{
  /** Equalise the exposure of the photographs by their `ExposureGain`, if present. Default off. */
  vtkFilterSwitchMacro(UseExposureGains, UseGains);
  ///@}

  ///@{
  /**
   * Subsamples per pixel side for the coverage of boundary pixels; even values are raised by one, and
   * 1 is no antialiasing. Default 1, range 1 to 9.
   */
  vtkFilterOptionMacro(BoundarySamples, int, BoundarySamples);
  ///@}

  ///@{
  /**
   * Give pixels of which less than half is covered their share of colour, although they are not of
   * the `Mask`: in a video the contour then moves continuously. Needs BoundarySamples above 1.
   * Default off.
   */
  vtkFilterSwitchMacro(SoftBoundary, SoftBoundary);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkViewDependentTextureMapper();
  ~vtkViewDependentTextureMapper() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  vtkSmartPointer<vtkPinholeCamera> Camera;

private:
  vtkViewDependentTextureMapper(const vtkViewDependentTextureMapper&) = delete;
  void operator=(const vtkViewDependentTextureMapper&) = delete;
};

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkTextureAtlasGenerator
 * @brief A mesh with the photographs' colours, for no camera: per point, and as charts with a texture.
 *
 * Where vtkViewDependentTextureMapper makes the image of one novel camera, this filter makes a
 * textured mesh for other programs. Every triangle is given to the photograph that shows it best;
 * connected triangles of one photograph are a chart, whose texture coordinates are the pixels of
 * that photograph; the charts are packed into one texture. Every texel is blended from all
 * photographs that see its surface point, as vtkViewDependentTextureMapper does for a camera that
 * looks straight at it, so that charts match at their seams (TextureAtlas.h).
 *
 * Ports:
 *  - in 0: vtkPolyData, triangles; n points.
 *  - in 1: vtkMultiBlockDataSet, the views (see ViewAccess.h) with `Color`, `Mask` and
 *    `ContourDistance`; field array `ExposureGain`.
 *  - out 0: vtkPolyData, the mesh with the point arrays `Color` (uint8 x 3, the scalars; where no
 *    photograph sees a point the mean of its neighbours) and `Normals` (float x 3, unit, outward; 0
 *    where there is none). No other arrays.
 *  - out 1: vtkPolyData, the triangles in their order, points at seams once per chart, with the point
 *    arrays `TCoords` (double x 2, 0 to 1, from the texture's bottom left), `Normals` (as above) and
 *    `OriginalPointIds` (vtkIdType, the point of the mesh it is).
 *  - out 2: vtkImageData, the texture, point array `Color` (uint8 x 3, the scalars; bottom-up rows).
 *    Its size follows from the charts and is not known before the update.
 *
 * Differs from the paper: the whole filter is an addition.
 *
 * Errors: no triangles, cells that are not triangles, no views, missing arrays, charts that fit at
 * no sensible scale.
 *
 * References: Chia, He and Lin 2013, section 3 (the blending); Lempitsky and Ivanov, "Seamless
 * mosaicing of image-based texture maps", CVPR 2007 (photographs chosen per triangle).
 */
#ifndef vtkTextureAtlasGenerator_h
#define vtkTextureAtlasGenerator_h

#include "FilterOptions.h"
#include "texture/TextureAtlasOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkPolyDataAlgorithm.h>

class vtkImageData;

class VTKNOVELVIEWFILTERS_EXPORT vtkTextureAtlasGenerator : public vtkPolyDataAlgorithm
{
public:
  static vtkTextureAtlasGenerator* New();
  vtkTypeMacro(vtkTextureAtlasGenerator, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** All options of the kernel. */
  vtkFilterOptionsMacro(novelview::TextureAtlasOptions);

  ///@{
  /** Largest side of the texture, pixels; charts are scaled down to fit. Default 4096, range 64 to 16384. */
  vtkFilterOptionMacro(TextureSize, int, LargestSidePx);
  ///@}

  ///@{
  /** Photographs blended per texel. Default 3, range 1 to 64. */
  vtkFilterOptionMacro(References, int, Texture.References);
  ///@}

  ///@{
  /** The exponent m of the weights. Default 4, range 0 to 64. */
  vtkFilterOptionMacro(Power, double, Texture.Power);
  ///@}

  ///@{
  /**
   * Width over which a photograph's weight grows from its silhouette's border inwards, pixels.
   * Default 20, range 0.01 to 100.
   */
  vtkFilterOptionMacro(FeatherWidth, double, Texture.FeatherPx);
  ///@}

  ///@{
  /**
   * Softness of the occlusion test in pixel footprints, see vtkViewDependentTextureMapper. Default
   * 1.5, range 0 to 100.
   */
  vtkFilterOptionMacro(OcclusionSoftness, double, Texture.OcclusionPx);
  ///@}

  ///@{
  /** Equalise the exposure of the photographs by their `ExposureGain`, if present. Default on. */
  vtkFilterSwitchMacro(UseExposureGains, Texture.UseGains);
  ///@}

  /** The mesh cut into charts, output 1. */
  vtkPolyData* GetAtlasMesh();
  /** The texture, output 2. */
  vtkImageData* GetTexture();

  ///@{
  /**
   * Of the last update: charts, the part of their texels that a photograph sees, and the part of
   * the texture that they cover, 0 to 1.
   */
  vtkGetMacro(NumberOfCharts, int);
  vtkGetMacro(SeenShare, double);
  vtkGetMacro(UsedShare, double);
  ///@}

protected:
  vtkTextureAtlasGenerator();
  ~vtkTextureAtlasGenerator() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  int NumberOfCharts = 0;
  double SeenShare = 0;
  double UsedShare = 0;

private:
  vtkTextureAtlasGenerator(const vtkTextureAtlasGenerator&) = delete;
  void operator=(const vtkTextureAtlasGenerator&) = delete;
};

#endif

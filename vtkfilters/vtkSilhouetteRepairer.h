// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkSilhouetteRepairer
 * @brief Adds to silhouettes the parts of the object that only they lack.
 *
 * The visual hull believes every silhouette: a part that one of them lacks, because it lies in
 * shadow, is taken off the object for good. Other silhouettes show such a part where the hull does
 * not cover them any more (SilhouetteRepair.h).
 *
 * Ports:
 *  - in 0: vtkMultiBlockDataSet, the views (see ViewAccess.h) with `Color`, `Mask` and
 *    `ContourDistance`.
 *  - in 1: vtkPolyData, the surface of the visual hull of these views (vtkVisualHullSource, port 1).
 *  - out 0: the same views, arrays shared; where a part was added, `Mask` and `ContourDistance` are
 *    those of the silhouette with it. Field array of each view: `AddedPixels` (1 double).
 *
 * GetRepaired() tells whether any silhouette has changed.
 *
 * Differs from the paper: the whole stage is an addition; preset `paper` runs without it.
 *
 * Errors: no views, missing arrays, cells that are not triangles.
 */
#ifndef vtkSilhouetteRepairer_h
#define vtkSilhouetteRepairer_h

#include "vtkNovelViewFiltersModule.h"
#include <vtkMultiBlockDataSetAlgorithm.h>

class VTKNOVELVIEWFILTERS_EXPORT vtkSilhouetteRepairer : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkSilhouetteRepairer* New();
  vtkTypeMacro(vtkSilhouetteRepairer, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Whether the last run has changed a silhouette. */
  vtkGetMacro(Repaired, bool);

protected:
  vtkSilhouetteRepairer();
  ~vtkSilhouetteRepairer() override = default;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  bool Repaired = false;

private:
  vtkSilhouetteRepairer(const vtkSilhouetteRepairer&) = delete;
  void operator=(const vtkSilhouetteRepairer&) = delete;
};

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkViewDeformer
 * @brief Base class of the deformers: ports, camera, iterations, the event after each.
 *
 * Ports:
 *  - in 0: vtkPolyData, triangles; point arrays `Visible` and `OutlineFlag` (uint8) when present.
 *  - in 1: vtkMultiBlockDataSet, the views (see ViewAccess.h) with `Color`, `Mask`,
 *    `ContourDistance`.
 *  - out 0: vtkPolyData, the moved mesh. All points of the input in their order; the caller's point
 *    arrays pass through; a deformer may drop triangles (then cell data are dropped, too). Added:
 *      `Displacement` (double x 3, world units, from the input of this filter; added to an array of
 *       that name in the input);
 *      the energy arrays a deformer names (double, 0 where the point is not its own).
 *
 * After each iteration, and once before the first, the filter invokes IterationEvent; GetCurrentMesh
 * (a mesh like the output), GetIteration and the mean energies can then be read.
 */
#ifndef vtkViewDeformer_h
#define vtkViewDeformer_h

#include "ArrayNames.h"
#include "deformation/DeformationOptions.h"
#include "vtkNovelViewFiltersModule.h"
#include <vtkCommand.h>
#include <vtkPolyDataAlgorithm.h>
#include <vtkSmartPointer.h>

class vtkMultiBlockDataSet;
class vtkPinholeCamera;

namespace novelview
{
struct DeformationState;
}

class VTKNOVELVIEWFILTERS_EXPORT vtkViewDeformer : public vtkPolyDataAlgorithm
{
public:
  vtkTypeMacro(vtkViewDeformer, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /** Invoked after each iteration. */
  enum Events
  {
    IterationEvent = vtkCommand::UserEvent + 1
  };

  ///@{
  /** The novel camera. Default: none, which is an error on update. */
  void SetCamera(vtkPinholeCamera* camera);
  vtkPinholeCamera* GetCamera();
  ///@}

  ///@{
  /** Iterations at most; 0 only measures the energies. Default 10, range 0 to 1000. */
  vtkSetClampMacro(NumberOfIterations, int, novelview::IterationsParameter.Min,
    novelview::IterationsParameter.Max);
  vtkGetMacro(NumberOfIterations, int);
  ///@}

  ///@{
  /** State of the iteration that IterationEvent reports; after an update, of the last one. */
  vtkPolyData* GetCurrentMesh();
  vtkGetMacro(Iteration, int);
  vtkGetMacro(PointsMoved, vtkIdType);
  ///@}

  ///@{
  /** Means over the points this filter moves. */
  vtkGetMacro(MeanEnergy, double);
  vtkGetMacro(MeanPhotoEnergy, double);
  vtkGetMacro(MeanContourEnergy, double);
  vtkGetMacro(MeanSmoothEnergy, double);
  ///@}

  vtkMTimeType GetMTime() override;

protected:
  vtkViewDeformer();
  ~vtkViewDeformer() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

  /**
   * The body of RequestData(): reads the inputs, calls Deform(), and outputs CurrentMesh, which the
   * listener that Deform() was given has made.
   */
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) final;

  /** What a deformer works on. */
  struct Work;
  /** Moves the points; throws novelview::Error. */
  virtual void Deform(const Work& work) = 0;

  /** Packs a state into CurrentMesh and the means, and invokes IterationEvent. */
  void ReportIteration(const novelview::DeformationState& state, vtkPolyData* input);

  /** Name of the second energy array: `EnergyContour` or `EnergyHull`. */
  virtual const char* ContourArrayName() const = 0;
  /** Whether the points this filter moves are the outline points. */
  virtual bool MovesOutline() const = 0;

  vtkSmartPointer<vtkPinholeCamera> Camera;
  vtkSmartPointer<vtkPolyData> CurrentMesh;
  int NumberOfIterations = novelview::IterationsParameter.Default;
  int Iteration = 0;
  vtkIdType PointsMoved = 0;
  double MeanEnergy = 0;
  double MeanPhotoEnergy = 0;
  double MeanContourEnergy = 0;
  double MeanSmoothEnergy = 0;

private:
  vtkViewDeformer(const vtkViewDeformer&) = delete;
  void operator=(const vtkViewDeformer&) = delete;
};

#endif

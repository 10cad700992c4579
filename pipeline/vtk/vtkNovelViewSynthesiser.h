// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkNovelViewSynthesiser
 * @brief The image that a camera would take of the object: all stages in one filter.
 *
 * Runs the chain of `novelview run` (Synthesis.h): silhouettes, visual hull, power crust, depth
 * maps, culling, outline, non-outline, texture. What does not depend on the novel camera is made at
 * the first update and kept until views or options change, so that further cameras take less time.
 *
 * Ports:
 *  - in 0: vtkMultiBlockDataSet, the views (see ViewAccess.h) with `Color`, `Mask` and
 *    `ContourDistance`.
 *  - out 0: vtkImageData, the novel view, with the point arrays of vtkViewDependentTextureMapper:
 *    `Color` (uint8 x 3, black around the object), `Mask` (uint8, coverage), `Depth` (float, world
 *    units, 0 = none), `CellId` (int, -1 = none), `Seen` (uint8, 0 = filled from the surroundings).
 *  - out 1: vtkPolyData, the mesh as refined for this camera, invisible triangles left out.
 *
 * ProgressEvent reports the progress of one stage after another, each from 0 to 1; GetProgressText
 * names the stage. Each warning about the data is a WarningEvent.
 *
 * Errors: no camera or one that is none, views without what is needed, an object that covers no
 * pixel, and those of the stages, with the stage's name.
 */
#ifndef vtkNovelViewSynthesiser_h
#define vtkNovelViewSynthesiser_h

#include "vtkNovelViewSynthesisModule.h"
#include <vtkImageAlgorithm.h>
#include <vtkSmartPointer.h>

#include <memory>
#include <string>

class vtkPinholeCamera;
class vtkPolyData;

class VTKNOVELVIEWSYNTHESIS_EXPORT vtkNovelViewSynthesiser : public vtkImageAlgorithm
{
public:
  static vtkNovelViewSynthesiser* New();
  vtkTypeMacro(vtkNovelViewSynthesiser, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The novel camera. Default: none, which is an error on update. */
  void SetCamera(vtkPinholeCamera* camera);
  vtkPinholeCamera* GetCamera();
  ///@}

  enum Stages
  {
    Hull = 0,
    Outline = 1,
    Full = 2
  };

  ///@{
  /** How far the geometry is refined before it is textured. Default: Full. */
  vtkSetClampMacro(Stage, int, Hull, Full);
  vtkGetMacro(Stage, int);
  void SetStageToHull() { this->SetStage(Hull); }
  void SetStageToOutline() { this->SetStage(Outline); }
  void SetStageToFull() { this->SetStage(Full); }
  ///@}

  ///@{
  /**
   * Sets all options to those of a preset: "best", the default, or "paper". Another name is an error
   * (ErrorEvent) that changes nothing.
   */
  void SetPreset(const char* name);
  std::string GetPreset();
  ///@}

  ///@{
  /**
   * The options by the names of job files, as a JSON object: `{"references": 3, "depthMaps": false}`.
   * Those not named stay as they are; "preset" comes first. An unknown name, a wrong type or a value
   * out of range is an error (ErrorEvent) that changes nothing; then false is returned. A name of an
   * earlier version is a WarningEvent that states the present one. The getter gives all of them
   * with their values.
   */
  bool SetOptions(const char* json);
  std::string GetOptions();
  ///@}

  /** What an option does, with unit and range; empty when there is none of this name. */
  std::string GetOptionHelp(const char* name);

  /** The refined mesh, output 1. */
  vtkPolyData* GetMesh();

  vtkMTimeType GetMTime() override;

protected:
  vtkNovelViewSynthesiser();
  ~vtkNovelViewSynthesiser() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  vtkSmartPointer<vtkPinholeCamera> Camera;
  int Stage = Full;

private:
  vtkNovelViewSynthesiser(const vtkNovelViewSynthesiser&) = delete;
  void operator=(const vtkNovelViewSynthesiser&) = delete;

  class Internals;
  std::unique_ptr<Internals> Impl;
};

#endif

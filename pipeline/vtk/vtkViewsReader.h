// SPDX-License-Identifier: GPL-3.0-or-later
/**
 * @class vtkViewsReader
 * @brief Reads a data set: calibrated photographs and their silhouettes.
 *
 * Reads what the program reads: a folder with photographs, their calibration and, perhaps, masks.
 * Silhouettes that there is no mask for are extracted from the photographs, whose background must then
 * be plain.
 *
 * Ports:
 *  - out 0: vtkMultiBlockDataSet, the views (see ViewAccess.h): a vtkImageData per photograph, named
 *    like it, with point arrays `Color`, `Mask` and `ContourDistance` and the camera's field arrays
 *    `CameraMatrix`, `Rotation` and `Translation`.
 *
 * What a user should know of a silhouette is a WarningEvent each.
 *
 * Errors: no folder set, and whatever is wrong with the calibration, a photograph or a mask.
 */
#ifndef vtkViewsReader_h
#define vtkViewsReader_h

#include "vtkNovelViewSynthesisModule.h"
#include <vtkMultiBlockDataSetAlgorithm.h>

#include <string>
#include <vector>

class vtkPinholeCamera;

class VTKNOVELVIEWSYNTHESIS_EXPORT vtkViewsReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkViewsReader* New();
  vtkTypeMacro(vtkViewsReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** The data set's folder. Default: none, which is an error on update. */
  vtkSetFilePathMacro(Folder);
  vtkGetFilePathMacro(Folder);
  ///@}

  ///@{
  /** The calibration file, for a folder that holds several. Default: none, the only one there is. */
  vtkSetFilePathMacro(Calibration);
  vtkGetFilePathMacro(Calibration);
  ///@}

  ///@{
  /** The calibration's format, as after the program's `--format`. Default: found. */
  vtkSetStringMacro(Format);
  vtkGetStringMacro(Format);
  ///@}

  ///@{
  /** Names of photographs to leave out. Default: none. */
  void AddExclude(const char* name);
  void RemoveAllExcludes();
  int GetNumberOfExcludes();
  const char* GetExclude(int i);
  ///@}

  ///@{
  /** Take silhouettes from the photographs although there are masks. Default off. */
  vtkSetMacro(ForceSilhouettes, bool);
  vtkGetMacro(ForceSilhouettes, bool);
  vtkBooleanMacro(ForceSilhouettes, bool);
  ///@}

  ///@{
  /**
   * Longer side in pixels to which photographs are reduced; 0 = never, negative = so that 4 GiB of
   * memory suffice for the synthesis. Default: negative.
   */
  vtkSetMacro(MaxSize, int);
  vtkGetMacro(MaxSize, int);
  ///@}

  /**
   * Sets `camera` to the one that a text describes, as after the program's `--view`:
   * `between:A,B[,F]`, `like:IMAGE` or `file:PAR.txt#NAME`. Photographs are not read, and none is
   * left out. On an error (ErrorEvent) the camera is left alone and false returned.
   */
  bool ReadCamera(const char* view, vtkPinholeCamera* camera);

protected:
  vtkViewsReader();
  ~vtkViewsReader() override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

  char* Folder = nullptr;
  char* Calibration = nullptr;
  char* Format = nullptr;
  std::vector<std::string> Excludes;
  bool ForceSilhouettes = false;
  int MaxSize = -1;

private:
  vtkViewsReader(const vtkViewsReader&) = delete;
  void operator=(const vtkViewsReader&) = delete;
};

#endif

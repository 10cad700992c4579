// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of all filters of the module: errors, and how kernels run under VTK.
#ifndef novelview_FilterSupport_h
#define novelview_FilterSupport_h

#include "Threads.h"
#include "ViewAccess.h"
#include "core/Error.h"
#include "core/Execution.h"
#include "vtkPinholeCamera.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkSetGet.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <exception>
#include <new>

namespace novelview
{
/** Kernels spread over vtkSMPTools, progress and abort through the filter. */
inline Execution ExecutionFor(vtkAlgorithm* filter)
{
  Execution execution;
  execution.ParallelFor = ParallelFor;
  execution.Progress = [filter](double fraction)
  {
    filter->UpdateProgress(fraction);
    return !filter->GetAbortExecute();
  };
  execution.StopRequested = StopRequested;
  return execution;
}

/**
 * Runs the body of a RequestData. An exception becomes an ErrorEvent with its one line of text, the
 * outputs are left empty, and the request fails.
 */
template <class Body>
int RunGuarded(vtkAlgorithm* filter, vtkInformationVector* outputs, const Body& body)
{
  try
  {
    body();
    return 1;
  }
  catch (const std::exception& error)
  {
    for (int i = 0; i < outputs->GetNumberOfInformationObjects(); ++i)
    {
      if (vtkDataObject* output = vtkDataObject::GetData(outputs, i))
      {
        output->Initialize();
      }
    }
    vtkErrorWithObjectMacro(filter, << ErrorText(error));
    return 0;
  }
}

/** The type of an input port: the views at one of them, vtkPolyData at the others. */
inline void SetInputType(vtkInformation* info, int port, int viewsPort)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
    port == viewsPort ? "vtkMultiBlockDataSet" : "vtkPolyData");
}

// ---- the camera member of a filter ----------------------------------------------------------

inline void SetCameraMember(
  vtkObject* filter, vtkSmartPointer<vtkPinholeCamera>& member, vtkPinholeCamera* camera)
{
  if (member != camera)
  {
    member = camera;
    filter->Modified();
  }
}

inline vtkMTimeType MTimeWithCamera(vtkMTimeType own, vtkPinholeCamera* camera)
{
  return camera ? std::max(own, camera->GetMTime()) : own;
}

/** The camera in the form of the kernels, validated; throws when there is none. */
inline Camera RequireCamera(vtkPinholeCamera* camera)
{
  if (!camera)
  {
    throw Error("novel camera", "none is set");
  }
  Camera result = ToCamera(camera);
  ValidateCamera(result, "novel camera");
  return result;
}

/** The RequestInformation of a filter whose output is the camera's image; empty without one. */
inline void SetPictureInformation(vtkInformationVector* outputs, vtkPinholeCamera* camera)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  const int* size = camera ? camera->GetImageSize() : nullptr;
  const int extent[6] = { 0, size ? size[0] - 1 : -1, 0, size ? size[1] - 1 : -1, 0, 0 };
  const double zeros[3] = { 0, 0, 0 };
  const double ones[3] = { 1, 1, 1 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  info->Set(vtkDataObject::ORIGIN(), zeros, 3);
  info->Set(vtkDataObject::SPACING(), ones, 3);
}

inline void PrintCamera(ostream& os, vtkIndent indent, vtkPinholeCamera* camera)
{
  os << indent << "Camera: ";
  if (camera)
  {
    os << "\n";
    camera->PrintSelf(os, indent.GetNextIndent());
  }
  else
  {
    os << "(none)\n";
  }
}
}

#endif

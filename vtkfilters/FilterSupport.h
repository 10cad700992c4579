// SPDX-License-Identifier: GPL-3.0-or-later
// What every filter of the module shares: the error route and how kernels run under VTK.
#ifndef novelview_FilterSupport_h
#define novelview_FilterSupport_h

#include "Error.h"
#include "Execution.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkInformationVector.h>
#include <vtkSMPTools.h>
#include <vtkSetGet.h>

#include <exception>

namespace novelview
{
/** Kernels spread over vtkSMPTools, progress and abort through the filter. */
inline Execution ExecutionFor(vtkAlgorithm* filter)
{
  Execution execution;
  execution.ParallelFor = [](std::int64_t count, const Execution::RangeBody& body)
  {
    vtkSMPTools::For(
      0, static_cast<vtkIdType>(count), [&](vtkIdType b, vtkIdType e) { body(b, e); });
  };
  execution.Progress = [filter](double fraction)
  {
    filter->UpdateProgress(fraction);
    return !filter->GetAbortExecute();
  };
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
    vtkErrorWithObjectMacro(filter, << error.what());
    return 0;
  }
}
}

#endif

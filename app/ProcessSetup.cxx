// SPDX-License-Identifier: GPL-3.0-or-later
#include "ProcessSetup.h"

#include "base/OutOfMemory.h"
#include "core/Error.h"

#include <vtkLogger.h>

#include <exception>
#include <new>

namespace novelview
{
namespace
{
/** For an exception that is not caught. */
[[noreturn]] void OnTerminate()
{
  try
  {
    if (const std::exception_ptr error = std::current_exception())
    {
      std::rethrow_exception(error);
    }
  }
  catch (const std::bad_alloc&)
  {
    EndWithError("out of memory");
  }
  catch (const std::exception& error)
  {
    EndWithError(ErrorText(error).c_str());
  }
  catch (...)
  {
  }
  EndWithError("an error of the program itself");
}
}

void SetUpProcess()
{
  std::set_terminate(OnTerminate);
  EndWhenOutOfMemory();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "Threads.h"

#include "core/Error.h"

#include <vtkSMPTools.h>

namespace novelview
{
namespace
{
std::atomic<const std::atomic<bool>*> StopFlag = nullptr;
}

void ParallelFor(
  std::int64_t count, const std::function<void(std::int64_t begin, std::int64_t end)>& body)
{
  vtkSMPTools::For(0, static_cast<vtkIdType>(count),
    [&body](vtkIdType begin, vtkIdType end) { body(begin, end); });
}

void SetNumberOfThreads(int count)
{
  // VTK 9.1 pays no heed to a number that was set already before 0 was; so 0 is set but once.
  static const int all = []
  {
    vtkSMPTools::Initialize(0);
    return vtkSMPTools::GetEstimatedNumberOfThreads();
  }();
  vtkSMPTools::Initialize(count > 0 ? count : all);
}

int NumberOfThreads()
{
  return vtkSMPTools::GetEstimatedNumberOfThreads();
}

void SetStopFlag(const std::atomic<bool>* flag)
{
  StopFlag = flag;
}

bool StopRequested()
{
  const std::atomic<bool>* flag = StopFlag;
  return flag && *flag;
}

void ThrowIfStopRequested()
{
  if (StopRequested())
  {
    throw Interrupted();
  }
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes/ProcessGroup.h"

#include "core/Error.h"

#include <algorithm>
#include <cstdlib>

namespace novelview
{
namespace
{
/** The number of the first environment variable that is set. */
int NumberOf(std::initializer_list<const char*> names, int otherwise)
{
  for (const char* name : names)
  {
    if (const char* text = std::getenv(name))
    {
      return std::atoi(text);
    }
  }
  return otherwise;
}
}

LaunchPlace FindLaunchPlace()
{
  // Open MPI's mpirun; launchers that speak PMI, such as MPICH's.
  LaunchPlace place;
  place.Size = std::max(NumberOf({ "OMPI_COMM_WORLD_SIZE", "PMI_SIZE" }, 1), 1);
  place.Rank = std::max(NumberOf({ "OMPI_COMM_WORLD_RANK", "PMI_RANK" }, 0), 0);
  place.SizeHere =
    std::max(NumberOf({ "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS" }, place.Size), 1);
  return place;
}

void ProcessGroup::Share(SceneGeometry&)
{
}

void ProcessGroup::ForEach(std::size_t count, const Make& make, const Take& take)
{
  for (std::size_t item = 0; item < count; ++item)
  {
    take(item, make(item));
  }
}

bool ProcessGroup::ReportFailure(const std::string&)
{
  return false;
}

void ProcessGroup::EndAll(int)
{
}

#ifndef NOVELVIEW_WITH_MPI
std::unique_ptr<ProcessGroup> StartProcesses(int*, char***, double)
{
  if (const int size = FindLaunchPlace().Size; size > 1)
  {
    throw Error("mpirun", "this program was built without MPI", std::to_string(size) + " processes",
      "1, or a build with VTK's ParallelMPI");
  }
  return std::make_unique<ProcessGroup>();
}

bool StoodStillTooLong()
{
  return false;
}
#endif
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "base/SystemMemory.h"

#include <fstream>
#include <string>

namespace novelview
{
double AvailableMemory()
{
  std::ifstream file("/proc/meminfo");
  std::string name;
  for (double kibibytes = 0; file >> name >> kibibytes;)
  {
    if (name == "MemAvailable:")
    {
      return 1024 * kibibytes;
    }
    std::getline(file, name);
  }
  return 0;
}
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "crust/TetLabels.h"

namespace novelview
{
bool IsInterior(const DelaunayComplex& complex, const std::vector<Side>& labels, int sample)
{
  const int begin = complex.IncidenceStart[sample];
  const int end = complex.IncidenceStart[sample + 1];
  for (int i = begin + 1; i < end; ++i)
  {
    if (labels[complex.Incidence[i]] != labels[complex.Incidence[begin]])
    {
      return false;
    }
  }
  return begin < end;
}
}

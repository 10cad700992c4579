// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Quantile_h
#define novelview_Quantile_h

#include <algorithm>
#include <cstddef>
#include <vector>

namespace novelview
{
/** The value at the rank share (n - 1), rounded down; 0 when there are none. */
inline double Quantile(std::vector<double> values, double share)
{
  if (values.empty())
  {
    return 0;
  }
  const auto rank = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[rank];
}
}

#endif

// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Execution_h
#define novelview_Execution_h

#include "Error.h"

#include <cstdint>
#include <functional>

namespace novelview
{
/**
 * How a kernel runs: who spreads its loops over threads, and who hears of its progress.
 *
 * Kernels know no VTK, so the filters hand them `vtkSMPTools::For` here; the default runs in the
 * calling thread. Determinism rule: the body writes only to slots that belong to its own indices
 * and reads nothing that another index writes, so the bits do not depend on the split.
 */
struct Execution
{
  /** Called with [begin, end) parts that together cover [0, count) exactly once. */
  using RangeBody = std::function<void(std::int64_t begin, std::int64_t end)>;

  std::function<void(std::int64_t count, const RangeBody& body)> ParallelFor =
    [](std::int64_t count, const RangeBody& body)
  {
    if (count > 0)
    {
      body(0, count);
    }
  };

  /** Hears the fraction done, 0 to 1; returns false to ask for a stop. Main thread only. */
  std::function<bool(double fraction)> Progress = [](double) { return true; };

  /** Reports progress, and throws Interrupted when the listener asks to stop. */
  void Report(double fraction) const
  {
    if (!this->Progress(fraction))
    {
      throw Interrupted();
    }
  }

  /** Calls body(i) for every i in [0, count), in parallel. */
  template <class Body>
  void ForEach(std::int64_t count, const Body& body) const
  {
    this->ParallelFor(count,
      [&body](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          body(i);
        }
      });
  }
};
}

#endif

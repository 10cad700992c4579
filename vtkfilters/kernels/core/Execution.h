// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_Execution_h
#define novelview_Execution_h

#include "core/Error.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

namespace novelview
{
/**
 * How a kernel runs: the function that distributes its loops over threads, and the receiver of its
 * progress.
 *
 * Kernels know no VTK, so the filters hand them `vtkSMPTools::For` here; the default runs in the
 * calling thread. Determinism rule: the body writes only to slots that belong to its own indices
 * and reads nothing that another index writes, so the bits do not depend on the split.
 *
 * A requested stop is checked often: by ForEach() between the calls of its body, and by
 * CheckCancelled(), which everything calls on its way that takes a tenth of a second or more.
 */
class Execution
{
  using Clock = std::chrono::steady_clock;

public:
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

  /**
   * Receives the fraction done, 0 to 1; returns false to request a stop. Called only in the thread
   * that made this Execution.
   */
  std::function<bool(double fraction)> Progress = [](double) { return true; };

  /** Whether to stop; may be called by any thread at any time. */
  std::function<bool()> StopRequested = [] { return false; };

  /**
   * Reports progress, and throws Interrupted when the listener requests a stop. Main thread only.
   */
  void Report(double fraction) const
  {
    this->Token->Fraction = fraction;
    this->Ask();
  }

  /** Throws Interrupted when a stop is requested. Costs some 50 ns; any thread. */
  void CheckCancelled() const
  {
    if (this->Token->Stopping || this->StopRequested())
    {
      throw Interrupted();
    }
    if (std::this_thread::get_id() == this->Token->Main &&
      Clock::now() - this->Token->Asked > std::chrono::milliseconds(50))
    {
      this->Ask();
    }
  }

  /** Calls body(i) for every i in [0, count), in parallel. Throws Interrupted as CheckCancelled() does. */
  template <class Body>
  void ForEach(std::int64_t count, const Body& body) const
  {
    struct Nothing
    {
    };
    this->ForEachWith(
      count, [] { return Nothing(); }, [&body](Nothing&, std::int64_t i) { body(i); });
  }

  /**
   * Calls body(scratch, i); scratch is what make() returns, once for every part of the loop, so that
   * the bodies need not allocate.
   */
  template <class Make, class Body>
  void ForEachWith(std::int64_t count, const Make& make, const Body& body) const
  {
    this->ParallelFor(count,
      [&](std::int64_t begin, std::int64_t end)
      {
        // Whoever spreads the loop need not stand exceptions.
        try
        {
          auto scratch = make();
          Throttle throttle;
          for (std::int64_t i = begin; i < end; ++i)
          {
            if (throttle.Due())
            {
              this->CheckCancelled();
            }
            body(scratch, i);
          }
        }
        catch (const Interrupted&)
        {
          this->Token->Stopping = true;
        }
      });
    this->CheckCancelled();
  }

private:
  void Ask() const
  {
    this->Token->Asked = Clock::now();
    if (!this->Progress(this->Token->Fraction))
    {
      this->Token->Stopping = true;
      throw Interrupted();
    }
  }

  struct TokenState
  {
    const std::thread::id Main = std::this_thread::get_id();
    std::atomic<bool> Stopping = false;
    double Fraction = 0;
    Clock::time_point Asked = Clock::now();
  };

  /** Reports to a loop every few milliseconds that time has passed, and rarely reads the clock. */
  class Throttle
  {
  public:
    bool Due()
    {
      if (--this->Left > 0)
      {
        return false;
      }
      const Clock::time_point now = Clock::now();
      const bool soon = now - this->Looked < std::chrono::milliseconds(3);
      this->Stride = soon ? 2 * this->Stride : std::max(this->Stride / 4, 1);
      this->Left = this->Stride;
      this->Looked = now;
      return true;
    }

  private:
    Clock::time_point Looked = Clock::now();
    int Stride = 1;
    int Left = 1;
  };

  std::shared_ptr<TokenState> Token = std::make_shared<TokenState>();
};
}

#endif

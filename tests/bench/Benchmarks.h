// SPDX-License-Identifier: GPL-3.0-or-later
#ifndef novelview_bench_Benchmarks_h
#define novelview_bench_Benchmarks_h

#include <benchmark/benchmark.h>

#include <exception>

namespace novelview::bench
{
void RegisterStages();
void RegisterKernels();

/** Runs the body of a benchmark; an exception is reported as its error. */
template <class Body>
void Guarded(benchmark::State& state, const Body& body)
{
  try
  {
    body();
  }
  catch (const std::exception& error)
  {
    state.SkipWithError(error.what());
  }
}
}

#endif

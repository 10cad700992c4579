// SPDX-License-Identifier: GPL-3.0-or-later
// Benchmarks of filters and kernels on generated photographs; options as of every Google Benchmark,
// e.g. --benchmark_list_tests, --benchmark_filter=texture. tests/bench/bench.sh runs all.
#include "Benchmarks.h"

int main(int argc, char** argv)
{
  novelview::bench::RegisterStages();
  novelview::bench::RegisterKernels();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return 2;
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

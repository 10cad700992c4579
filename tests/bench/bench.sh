#!/usr/bin/env bash
# What NovelView costs: builds it, generates photographs of several sizes in out/bench/data (kept for
# the next time), measures, and prints as Markdown
#   - targets and what was measured,
#   - stage x size of the data x threads of whole runs, with each further view and peak memory,
#   - stages and kernels alone (Google Benchmark),
#   - exponents of the growth with photographs, pixels, samples and pixels of the novel view.
# Beside them in out/bench: bench.md (the same), runs.csv and runs.json (every run), kernels.json,
# growth-PRESET.png. Let nothing else run meanwhile; it tells what share of the processor others took.
#
# usage: tests/bench/bench.sh [--quick] [--out DIR] [--parts kernels,runs,growth] [--presets best,paper]
#                             [--data small,middle,large] [--threads 1,2] [--repetitions N]
#   --quick   one repetition of small sizes, some minutes: shows that it works, not how fast it is
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=${NOVELVIEW_BUILD:-$root/build}
unset DISPLAY
"$root/app/setup.sh" novelview bench_novelview >&2
exec /usr/bin/python3 -B "$root/tests/bench/bench.py" --program "$build/bin/novelview" \
  --kernels "$build/bin/bench_novelview" --out "$root/out/bench" "$@"

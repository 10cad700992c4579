#!/usr/bin/env bash
# Feeds the readers of people's files with spoilt ones, SECONDS each (default 60), with libFuzzer,
# AddressSanitizer and UBSan, all built by clang in build-fuzz/ (or in $NOVELVIEW_FUZZ_BUILD). A file
# that makes a reader crash, hang, take 2 GB or break a promise is kept and named; the exit code is 1.
# What the fuzzers have learnt stays in build-fuzz/corpus/ for the next time.
# usage: tests/fuzz.sh [SECONDS [FUZZER ...]], all fuzzers when none is named
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOVELVIEW_FUZZ_BUILD:-$root/build-fuzz}
seconds=${1:-60}
case $seconds in
  "" | *[!0-9]*)
    echo "fuzz.sh: SECONDS must be a whole number (got \"$seconds\")" >&2
    exit 2
    ;;
esac
fuzzers=("${@:2}")
if [ ${#fuzzers[@]} -eq 0 ]; then
  fuzzers=(FuzzMeshPly FuzzMeshObj FuzzMeshStl FuzzMeshVtp FuzzCalibration FuzzJob)
fi
unset DISPLAY

"$root/app/install-packages.sh" "$root/app/packages-dev.txt"
"$root/app/configure.sh" "$build" -DNOVELVIEW_FUZZERS=ON \
  -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DBUILD_SHARED_LIBS=OFF \
  -DNOVELVIEW_BUILD_TESTS=OFF -DNOVELVIEW_BUILD_BENCHMARKS=OFF
cmake --build "$build" --target "${fuzzers[@]}" MakeSeeds

# Files that the harnesses write stay in memory where they can.
scratch=$(TMPDIR=$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}") mktemp -d)
trap 'rm -rf "$scratch"' EXIT
"$build/bin/MakeSeeds" "$build/seeds"
export UBSAN_OPTIONS=print_stacktrace=1
failed=0
for fuzzer in "${fuzzers[@]}"; do
  mkdir -p "$build/corpus/$fuzzer" "$build/found"
  log=$build/$fuzzer.log
  if TMPDIR=$scratch "$build/bin/$fuzzer" -max_total_time="$seconds" -timeout=10 \
    -rss_limit_mb=2048 -max_len=65536 -print_final_stats=1 \
    -artifact_prefix="$build/found/$fuzzer-" \
    "$build/corpus/$fuzzer" "$build/seeds/$fuzzer" >"$log" 2>&1; then
    result="nothing found"
  else
    failed=1
    result="FAILED: $(sed -n 's/.*Test unit written to //p' "$log" | tail -1) (see $log)"
  fi
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "$fuzzer: ${runs:-?} runs in $seconds s, $result"
done
exit $failed

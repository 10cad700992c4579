#!/usr/bin/env bash
# Runs the test suite in a separate build, with instrumentation by the compiler in everything:
#   sanitize  AddressSanitizer and UBSan, in build-sanitize/
#   tsan      ThreadSanitizer, in build-tsan/; tsan.supp lists what it ignores
#   coverage  counters, in build-coverage/; prints which lines and branches of each layer have run
# usage: tests/instrumented.sh sanitize|tsan|coverage [ctest options]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
kind=${1:-}
build=$root/build-$kind
unset DISPLAY
# Libraries that are loaded through a sanitizer's dlopen are not looked for beside the caller.
export LD_LIBRARY_PATH=$build/lib
run=()
case $kind in
  sanitize)
    option=-DNOVELVIEW_SANITIZE=address
    export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
    ;;
  tsan)
    option=-DNOVELVIEW_SANITIZE=thread
    export TSAN_OPTIONS="suppressions=$root/tests/tsan.supp halt_on_error=1"
    # Of VTK's ways to run a loop in parallel, the one that ThreadSanitizer sees through: threads that
    # are started and joined. TBB's scheduler orders them by atomics in a library without its code.
    export VTK_SMP_BACKEND_IN_USE=STDThread
    # It keeps its memory at fixed addresses, which a randomised address space may take.
    run=(setarch "$(uname -m)" --addr-no-randomize)
    ;;
  coverage)
    option=-DNOVELVIEW_COVERAGE=ON
    "$root/app/install-packages.sh" "$root/app/packages-dev.txt"
    ;;
  *)
    echo "instrumented.sh: sanitize, tsan or coverage? (got \"$kind\")" >&2
    exit 2
    ;;
esac

"$root/app/configure.sh" "$build" "$option" -DNOVELVIEW_BUILD_BENCHMARKS=OFF
"${run[@]}" cmake --build "$build"
if [ "$kind" = coverage ]; then
  find "$build" -name '*.gcda' -delete
fi
failed=0
(cd "$build" && "${run[@]}" ctest --output-on-failure --parallel 2 "${@:2}") || failed=1
if [ "$kind" = coverage ]; then
  "$root/tests/coverage.py" "$build"
fi
exit $failed

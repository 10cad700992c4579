#!/usr/bin/env bash
# Builds NovelView and runs its whole test suite: no display needed. With one of these as the first
# option, it does something else instead:
#   --fuzz [SECONDS [FUZZER ...]]  runs the fuzzers, see fuzz.sh
#   --sanitize [ctest options]     the suite under AddressSanitizer and UBSan, see instrumented.sh
#   --tsan [ctest options]         the suite under ThreadSanitizer, see instrumented.sh
#   --coverage [ctest options]     which lines and branches the suite runs, see instrumented.sh
#   --lint [FILE ...]              checks the sources without running them, see lint.sh
#   --doc                          the pages of vtkfilters/, see doc.sh
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
case ${1:-} in
  --fuzz | --lint | --doc) exec "$root/tests/${1#--}.sh" "${@:2}" ;;
  --sanitize | --tsan | --coverage) exec "$root/tests/instrumented.sh" "${1#--}" "${@:2}" ;;
esac
build=${NOVELVIEW_BUILD:-$root/build}
env -u DISPLAY "$root/app/setup.sh"
cd "$build"
env -u DISPLAY ctest --output-on-failure --parallel 2 "$@"

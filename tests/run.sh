#!/usr/bin/env bash
# Builds NovelView and runs its whole test suite: no display needed. With --fuzz [SECONDS [FUZZER ...]]
# it runs the fuzzers instead, see fuzz.sh.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
if [ "${1:-}" = --fuzz ]; then
  exec "$root/tests/fuzz.sh" "${@:2}"
fi
build=${NOVELVIEW_BUILD:-$root/build}
env -u DISPLAY "$root/app/setup.sh"
cd "$build"
env -u DISPLAY ctest --output-on-failure --parallel 2 "$@"

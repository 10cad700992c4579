#!/usr/bin/env bash
# Builds NovelView and runs its whole test suite: no display needed.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOVELVIEW_BUILD:-$root/build}
env -u DISPLAY "$root/app/setup.sh"
cd "$build"
env -u DISPLAY ctest --output-on-failure --parallel 2 "$@"

#!/usr/bin/env bash
# Installs the missing packages of app/packages.txt, configures, and builds into build/ (or into
# $NOVELVIEW_BUILD). Run by app/demo.sh and tests/run.sh; may be run alone, as root or as a user who
# may use sudo. usage: app/setup.sh [TARGET ...], everything when no target is given
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOVELVIEW_BUILD:-$root/build}

"$root/app/install-packages.sh" "$root/app/packages.txt" || {
  echo "Then build with: cmake -S '$root' -B '$build' -G Ninja && cmake --build '$build'" >&2
  exit 1
}

# What CMake finds is told only when it fails.
mkdir -p "$build"
log=$build/configure.log
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo >"$log" 2>&1 ||
  { cat "$log" >&2; exit 1; }
cmake --build "$build" ${1:+--target "$@"}

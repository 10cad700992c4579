#!/usr/bin/env bash
# Installs the missing packages of app/packages.txt and configures a build folder. What CMake finds is
# printed only if it fails. Run by app/setup.sh and by the scripts of tests/.
# usage: app/configure.sh BUILD [CMAKE OPTION ...]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$1

"$root/app/install-packages.sh" "$root/app/packages.txt" || {
  echo "Then build with: cmake -S '$root' -B '$build' -G Ninja ${*:2} && cmake --build '$build'" >&2
  exit 1
}
mkdir -p "$build"
log=$build/configure.log
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo "${@:2}" >"$log" 2>&1 ||
  { cat "$log" >&2; exit 1; }

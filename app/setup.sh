#!/usr/bin/env bash
# Installs the missing packages of app/packages.txt, configures, and builds into build/ (or into
# $NOVELVIEW_BUILD). Run by app/demo.sh and tests/run.sh; may be run alone, as root or as a user who
# may use sudo. usage: app/setup.sh [TARGET ...], everything when no target is given
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOVELVIEW_BUILD:-$root/build}

if ! command -v dpkg-query >/dev/null; then
  echo "This is no Debian system. Install what app/packages.txt names, by this system's names, and" >&2
  echo "build with: cmake -S '$root' -B '$build' -G Ninja && cmake --build '$build'" >&2
  exit 1
fi
mapfile -t packages < <(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$root/app/packages.txt")
missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -gt 0 ]; then
  install=(env DEBIAN_FRONTEND=noninteractive apt-get)
  if [ "$(id -u)" -ne 0 ]; then
    if command -v sudo >/dev/null && sudo -v; then
      install=(sudo "${install[@]}")
    else
      echo "Packages are missing and this user may not install them. As root, run:" >&2
      echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
      exit 1
    fi
  fi
  echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  "${install[@]}" update -qq
  "${install[@]}" install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

# What CMake finds is told only when it fails.
mkdir -p "$build"
log=$build/configure.log
cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo >"$log" 2>&1 ||
  { cat "$log" >&2; exit 1; }
cmake --build "$build" ${1:+--target "$@"}

#!/usr/bin/env bash
# Installs the missing packages of app/packages.txt, configures and builds into build/.
# Run by app/demo.sh and tests/run.sh; may be run alone. As root, or as a user with sudo.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOVELVIEW_BUILD:-$root/build}

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

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo "$@" >"$root/.configure.log" 2>&1 ||
  { cat "$root/.configure.log" >&2; exit 1; }
rm -f "$root/.configure.log"
cmake --build "$build"

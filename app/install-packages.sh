#!/usr/bin/env bash
# Installs the Debian packages of a list that are missing: a name a line, # begins a comment. Run by
# app/configure.sh and the scripts of tests/, as root or as a user who may use sudo.
# usage: app/install-packages.sh LIST
set -euo pipefail
list=$1

if ! command -v dpkg-query >/dev/null; then
  echo "This is no Debian system. Install what $list names, by this system's names." >&2
  exit 1
fi
mapfile -t packages < <(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' "$list")
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

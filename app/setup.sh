#!/usr/bin/env bash
# Installs the missing packages of app/packages.txt, configures, and builds into build/ (or into
# $NOVELVIEW_BUILD). Run by app/demo.sh and tests/run.sh; may be run alone, as root or as a user who
# may use sudo. usage: app/setup.sh [TARGET ...], everything when no target is given
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${NOVELVIEW_BUILD:-$root/build}

"$root/app/configure.sh" "$build"
cmake --build "$build" ${1:+--target "$@"}

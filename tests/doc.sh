#!/usr/bin/env bash
# Makes pages of the doc comments of vtkfilters/ and its kernels, in build/doc (or in
# $NOVELVIEW_BUILD/doc). Fails if Doxygen prints a warning.
# usage: tests/doc.sh
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export NOVELVIEW_DOC=${NOVELVIEW_BUILD:-$root/build}/doc

"$root/app/install-packages.sh" "$root/app/packages-dev.txt"
NOVELVIEW_VERSION=$(sed -n 's/^project(NovelView VERSION \([0-9.]*\).*/\1/p' "$root/CMakeLists.txt")
export NOVELVIEW_VERSION
mkdir -p "$NOVELVIEW_DOC"
cd "$root"
doxygen .github/Doxyfile
echo "$NOVELVIEW_DOC/html/index.html"

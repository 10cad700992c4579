#!/usr/bin/env bash
# Checks that the layout of the sources is that of .clang-format; --fix applies it. Other versions
# of clang-format would do it otherwise: the exit code is 77 (skipped) where there is not this one.
# usage: tests/format.sh [--fix]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
version=14

program=
for name in clang-format-$version clang-format; do
  if "$name" --version 2>/dev/null | grep -q "version $version\."; then
    program=$name
    break
  fi
done
if [ -z "$program" ]; then
  echo "skipped: clang-format $version is not installed"
  exit 77
fi
how=(--dry-run -Werror)
if [ "${1:-}" = --fix ]; then
  how=(-i)
fi
cd "$root"
find app pipeline tests vtkfilters -name '*.h' -o -name '*.cxx' | sort | xargs "$program" "${how[@]}"

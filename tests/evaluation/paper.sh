#!/usr/bin/env bash
# Tables 1 to 4 of the paper: builds NovelView, runs the job files data/jobs/paper-*.json, and prints
# the RMS after every iteration. The photographs of the dinosaur are looked for in data/dino12 and in
# $NOVELVIEW_SHARED/data/dino12; without them its tables are left out. Takes about a minute.
# usage: tests/evaluation/paper.sh [OUT]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
out=${1:-$root/out/paper}
build=${NOVELVIEW_BUILD:-$root/build}
unset DISPLAY
"$root/app/setup.sh" novelview >&2
mkdir -p "$out/data"
for dinosaur in "$root/data/dino12" "${NOVELVIEW_SHARED:-$root/../shared}/data/dino12"; do
  if [ -d "$dinosaur" ]; then
    ln -sfn "$(cd "$dinosaur" && pwd)" "$out/data/dino12"
    break
  fi
done
/usr/bin/python3 -B "$root/tests/evaluation/paper_tables.py" "$build/bin/novelview" \
  "$root/data/jobs" "$out/data" "$out" | tee "$out/paper.md"

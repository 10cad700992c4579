#!/usr/bin/env bash
# Where the energies of preset paper have their least, for points whose true position is known: builds
# NovelView, generates the wooden bunny and the marble torus of the ablation, and prints the tables of
# tests/README.md. Beside them in OUT: energy.md (the same), energy.csv and energy-NAME.png (the mean
# landscapes). Takes about ten seconds.
# usage: tests/evaluation/energy.sh [OUT]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
out=${1:-$root/out/energy}
build=${NOVELVIEW_BUILD:-$root/build}
unset DISPLAY
"$root/app/setup.sh" novelview energy_landscape >&2
for object in bunny=wood torus=marble; do
  "$build/bin/novelview" generate --mesh "${object%=*}" --texture "${object#*=}" \
    --test-angles 15,75,165,255 --quiet --out "$out/data/${object%=*}"
done
exec "$build/bin/energy_landscape" "$out" "bunny=$out/data/bunny" "torus=$out/data/torus"

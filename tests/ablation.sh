#!/usr/bin/env bash
# Which part of the method is worth what: builds NovelView, generates the objects, predicts their test
# views with every configuration below, and writes OUT/ablation.md. What is finished and newer than
# the program is not done again, so it may be interrupted and started again. Takes about a quarter of an hour on
# two cores. usage: [NOVELVIEW_TEMPLE=DIR] tests/ablation.sh [OUT]
#   NOVELVIEW_TEMPLE   folder of Middlebury's templeSparseRing, see data/README.md; left out if not set
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${1:-$root/out/ablation}
build=${NOVELVIEW_BUILD:-$root/build}
program=$build/bin/novelview
unset DISPLAY

# name|options of evaluate
configurations=(
  "paper|--preset paper"
  "paper + depth maps|--preset paper --depth-maps"
  "best without refined cameras|--no-refine-cameras"
  "best without repaired silhouettes|--no-repair-silhouettes"
  "best without reconciled silhouettes|--no-reconcile-silhouettes"
  "best without contour prediction|--no-contour-prediction"
  "best without measured depth noise|--depth-noise 0.15"
  "best without exposure gains|--no-exposure-gains"
  "best without cut edges|--longest-edge 0"
  "best|"
)
# name|options of generate
objects=(
  "bunny wood|--mesh bunny --texture wood"
  "stool wood|--mesh stool --texture wood"
  "part checker|--mesh part --texture checker"
  "torus marble|--mesh torus --texture marble"
  "bust plaster|--mesh bust --texture plaster"
  "bunny, 2 masks shrunk 2 px|--mesh bunny --texture wood --mask-erode 2 --mask-erode-views 1,5"
  "bunny, 2 masks grown 2 px|--mesh bunny --texture wood --mask-erode -2 --mask-erode-views 1,5"
  "bunny, calibration off 0.75 px|--mesh bunny --texture wood --calibration-noise 0.75"
  "bunny, brightness off 10 %|--mesh bunny --texture wood --gain-spread 0.1"
  "glossy bunny from one side|--mesh bunny --light rig --gloss 0.8 --exposure 1.5 --step 12 --elevation 20 --test-angles 18,54,90,126 --defocus 0.8 --noise 2 --jpeg 75 --vignetting 0.2 --masks threshold"
  "turntable, bust plaster|--mesh bust --texture plaster --light rig --noise 2 --jpeg 90 --calibration-noise 0.3"
  "turntable, stool plaster|--mesh stool --texture plaster --light rig --noise 2 --jpeg 90 --calibration-noise 0.3"
  "turntable, bust glazed|--mesh bust --texture marble --light rig --gloss 0.7 --exposure 1.3 --defocus 1 --noise 2 --jpeg 80 --masks threshold"
  "turntable, bunny, wrong lenses|--mesh bunny --light rig --gloss 0.3 --noise 2 --jpeg 90 --calibration-noise 0.3 --focal-noise 0.002 --principal-noise 1"
  "turntable, part wood|--mesh part --texture wood --light rig --noise 2 --jpeg 90 --elevation 20"
  "lattice, two rings|--mesh lattice --noise 1 --jpeg 90 --elevation 15 --second-ring 20"
)

slug() { tr -cs 'a-zA-Z0-9.' '-' <<<"$1" | sed 's/-*$//'; }

# done_by FILE COMMAND: FILE was made by this very command and by this very build
done_by() {
  [ -f "$1" ] && [ "$(cat "$1.command" 2>/dev/null)" = "$2" ] &&
    [ -z "$(find "$program" "$build/lib" -type f \( -name novelview -o -name '*.so*' \) -newer "$1")" ]
}

# make FILE LOG COMMAND...: runs the command, whose last file is FILE, unless that is done
make() {
  local file=$1 log=$2 status=0
  shift 2
  if done_by "$file" "$*"; then
    return
  fi
  mkdir -p "$(dirname "$file")" "$(dirname "$log")"
  rm -f "$file" "$file.command"
  "$@" >"$log" 2>&1 || status=$?
  if [ $status -ne 0 ]; then
    echo "failed ($status): $*" >&2
    tail -n 1 "$log" >&2
    exit $status
  fi
  echo "$*" >"$file.command"
}

# evaluate OBJECT DATA OPTIONS...: every configuration on one data set
evaluate() {
  local object=$1 data=$2 configuration name options run
  shift 2
  for configuration in "${configurations[@]}"; do
    name=${configuration%%|*}
    read -ra options <<<"${configuration#*|}"
    run=$out/runs/$(slug "$object")/$(slug "$name")
    echo "$object, $name"
    make "$run/scores.json" "$run/log.txt" \
      "$program" evaluate "$data" --out "$run" --no-pictures --cache "$out/cache" "$@" "${options[@]}"
    printf '%s\t%s\t%s\n' "$object" "$name" "$run/scores.json" >>"$out/runs.tsv"
  done
}

"$root/app/setup.sh" novelview
mkdir -p "$out"
out=$(cd "$out" && pwd)
: >"$out/runs.tsv"
for object in "${objects[@]}"; do
  name=${object%%|*}
  read -ra options <<<"${object#*|}"
  [[ " ${options[*]} " == *" --test-angles "* ]] || options+=(--test-angles "15,75,165,255")
  data=$out/data/$(slug "$name")
  echo "$name, photographs"
  make "$data/generate.json" "$out/data/$(slug "$name").log" \
    "$program" generate --out "$data" "${options[@]}"
  evaluate "$name" "$data"
done
if [ -n "${NOVELVIEW_TEMPLE:-}" ]; then
  evaluate "temple" "$(cd "$NOVELVIEW_TEMPLE" && pwd)" \
    --hold-out templeSR0004.png,templeSR0012.png
fi
python3 "$root/tests/ablation_table.py" "$out/runs.tsv" >"$out/ablation.md.part"
mv "$out/ablation.md.part" "$out/ablation.md"
echo "The tables: $out/ablation.md; into the READMEs by: tests/ablation_table.py $out/runs.tsv --readme README.md tests/README.md"

#!/usr/bin/env bash
# The main job, from nothing: builds NovelView, photographs a wood-textured Stanford bunny with twelve
# virtual cameras, and makes the picture a thirteenth, half-way between camera 0 and camera 1, would
# take. No display is needed. usage: app/demo.sh [OUT]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=${1:-$root/out}
build=${NOVELVIEW_BUILD:-$root/build}
unset DISPLAY
"$root/app/setup.sh" novelview
"$build/bin/novelview" generate --out "$out/bunny" --mesh bunny --texture wood --views 12 --step 30 \
  --size 640x480 --test-angles 15
"$build/bin/novelview" run "$out/bunny" --out "$out/novel" \
  --view "file:$out/bunny/test/test_par.txt#test0000.png" --true-mesh "$out/bunny/truth.ply"
cat <<END

The data set      $out/bunny            (overview.png shows the rig)
The novel view    $out/novel/novel.png  (truth.png beside it)
After each stage  $out/novel/stages/
Each iteration    $out/novel/iterations/ (pictures), $out/novel/meshes/iterations.pvd (ParaView)
RMS tables        $out/novel/rms_outline.csv, $out/novel/rms_nonoutline.csv, chart $out/novel/rms.png
The report        $out/novel/report.html (all of this, for a browser)
Summary           $out/novel/summary.json; the job, to run again: $out/novel/job.json
END

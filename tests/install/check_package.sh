#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes the Debian package of a build, unpacks it, and uses what is in it: program, manual pages,
# completion, Python package. usage: check_package.sh BUILD WORK PYTHON
set -euo pipefail
build=$1 work=$2 python=$3
fail() { echo "check_package: $*" >&2; exit 1; }
rm -rf "$work"
mkdir -p "$work"
cpack -G DEB --config "$build/CPackConfig.cmake" -B "$work" >"$work/cpack.log" 2>&1 ||
  { cat "$work/cpack.log" >&2; exit 1; }
package=$(echo "$work"/novelview_*.deb)
for needed in libvtk9 libopencv-core libopencv-videoio libosmesa6; do
  dpkg-deb --field "$package" Depends | grep -q "$needed" || fail "does not depend on $needed"
done
root=$work/root
dpkg-deb --extract "$package" "$root"
[ -f "$root/usr/share/doc/novelview/copyright" ] || fail "no copyright"

export LD_LIBRARY_PATH=$root/usr/lib:$root/usr/lib/x86_64-linux-gnu
export PATH=$root/usr/bin:$PATH
unset DISPLAY
program=$(command -v novelview)
[ "$program" = "$root/usr/bin/novelview" ] || fail "runs $program"
novelview generate --mesh torus --size 120x90 --views 8 --step 45 --test-angles 22.5 --quiet \
  --out "$work/torus"
novelview run "$work/torus" --view between:0,1 --no-iterations --quiet --out "$work/run"
[ -s "$work/run/novel.png" ] || fail "no picture"
# What is loaded only for this is found without being told where.
env -u LD_LIBRARY_PATH novelview orbit "$work/torus" --frames 2 --stage hull --quiet \
  --out "$work/film.mp4"
PYTHONPATH=$root/usr/lib/python3/dist-packages "$python" -c \
  "import novelview; assert novelview.__file__.startswith('$root'), novelview.__file__
views = novelview.read('$work/torus')
novelview.image(novelview.synthesise(views, novelview.between(views, 0, 1), stage='hull'), 'Color')"

commands=$(novelview --help | sed -n -e '/^Subcommands:/,$s/^  \([a-z][a-z]*\) .*/\1/p')
[ -n "$commands" ] || fail "help names no command"
for command in $commands; do
  page=$root/usr/share/man/man1/novelview-$command.1
  [ -f "$page" ] || fail "no manual page of $command"
  grep -q "^novelview-$command " "$page" || fail "$page has another name"
done

# shellcheck source=/dev/null
source "$root/usr/share/bash-completion/completions/novelview"
expect() { # ANSWER WORD...: what completing the last word answers
  local answer=$1
  shift
  COMP_WORDS=("$@") COMP_CWORD=$(($# - 1))
  _novelview
  [ "${COMPREPLY[*]}" = "$answer" ] || fail "completes '$*' with '${COMPREPLY[*]}', not '$answer'"
}
expect "run" novelview ru
expect "--preset" novelview run --pre
expect "best paper" novelview run DATA --preset ""
expect "outline" novelview render --stage ou
cd "$work"
expect "torus" novelview run tor

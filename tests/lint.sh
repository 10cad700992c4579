#!/usr/bin/env bash
# Checks the sources without running them: clang-format, the folders and their includes, shellcheck for
# scripts, flake8 for Python, and clang-tidy with .clang-tidy for the C++ of vtkfilters, pipeline and app
# (or of the FILEs or folders that are named). Each prints its findings; the exit code is 1 if there are any.
# usage: tests/lint.sh [FILE ...]
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build-lint
files=("$@")
if [ ${#files[@]} -eq 0 ]; then
  files=("$root/vtkfilters" "$root/pipeline" "$root/app")
fi
mapfile -t sources < <(find "${files[@]}" -name '*.cxx' -exec realpath {} + | sort)
cd "$root"
failed=0
check() {
  echo "== $1"
  "${@:2}" || failed=1
}

"$root/app/install-packages.sh" "$root/app/packages-dev.txt"
mapfile -t scripts < <(find .ci app pipeline tests -name '*.sh' -o -path .ci/run)
mapfile -t python < <(find pipeline tests -name '*.py')
check clang-format tests/format.sh
check folders python3 -B tests/rooms.py
check shellcheck shellcheck "${scripts[@]}"
# Errors only, layout apart; a package may hand on all the names of its modules.
check flake8 /usr/bin/python3 -m flake8 --isolated --select=E9,F --extend-ignore=F403,F405 \
  --per-file-ignores='__init__.py:F401' "${python[@]}"

# It reads the sources as clang would compile them; generated headers are there once CMake has run.
"$root/app/configure.sh" "$build" -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON -DNOVELVIEW_BUILD_BENCHMARKS=OFF
printf '%s\n' "${sources[@]}" >"$build/sources.txt"
check clang-tidy xargs -a "$build/sources.txt" -d '\n' -n 1 -P "$(nproc)" \
  clang-tidy --quiet -p "$build" 2> >(grep -v 'warnings\? generated' >&2)
exit $failed

#!/bin/sh
# Every OpenGL function that VTK's libraries call by name must be one of the program's own
# (pipeline/drawing/OpenGLFunctions.cxx); another would go to the system's OpenGL, which draws nothing
# without a display. usage: check_opengl.sh PROGRAM
set -eu
libraries=$(ldd "$1" | sed -n 's/.* => \([^ ]*libvtkRendering[^ ]*\|[^ ]*libvtkCharts[^ ]*\) .*/\1/p')
test -n "$libraries"
own=$(for file in "$1" $(ldd "$1" | sed -n 's/.* => \([^ ]*libNovelView[^ ]*\) .*/\1/p'); do
  nm -D --defined-only "$file"
done | awk '$3 ~ /^gl[A-Z]/ { print $3 }' | sort -u)
missing=$(for library in $libraries; do
  nm -D --undefined-only "$library"
done | awk '$2 ~ /^gl[A-Z]/ && $2 !~ /^glX/ { sub(/@.*/, "", $2); print $2 }' | sort -u |
  grep -vxF "$own" || true)
if [ -n "$missing" ]; then
  echo "OpenGL functions that VTK calls and the program does not pass on: $(echo "$missing" | tr '\n' ' ')"
  exit 1
fi

#!/bin/sh
# run.sh BUILD SUITE: tests of the add-on inside Blender; `window` in a window, `measure` measures. Where there
# is no Blender that can run them, says why and exits with 77, which ctest knows as skipped.
set -u
FORETOUCH_BUILD=$(realpath "$1")
export FORETOUCH_BUILD PYTHONDONTWRITEBYTECODE=1
suite=$2
here=$(dirname "$0")

skip() {
  echo "[  SKIPPED ] blender.$suite: $1"
  exit 77
}

command -v blender >/dev/null || skip "there is no blender (Debian: apt install blender)"
ls "$FORETOUCH_BUILD"/lib/python3/dist-packages/foretouch/_foretouch*.so >/dev/null 2>&1 || skip "the Python package is not built"
blender -b --factory-startup --python-exit-code 1 --python-expr \
  'import sys; sys.exit(sys.version_info[:2] != (3, 11))' >/dev/null 2>&1 ||
  skip "Blender's Python is not the 3.11 that the package is built for"
case $suite in
  window)
    command -v xvfb-run >/dev/null || skip "there is no xvfb-run (Debian: apt install xvfb xauth libgl1-mesa-dri)"
    xvfb-run -a -s "-screen 0 1280x800x24" timeout 250 blender --factory-startup --enable-event-simulate \
      --python "$here/window.py" 2>&1 | tee /dev/stderr | grep -q "^WINDOW passed"
    ;;
  measure)
    blender -b --factory-startup --python-exit-code 1 --python "$here/measure.py" | grep "^MEASURED"
    ;;
  *)
    exec blender -b --factory-startup --python-exit-code 1 --python "$here/run.py" -- "$suite"
    ;;
esac

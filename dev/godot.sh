#!/usr/bin/env bash
# godot.sh godot [--addon|--cost|--hands [N]]: the add-on for Godot.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh
package=integrations/godot

# The demo with the add-on in it, and the library as release files have it.
make_addon() {
  configure portable
  cmake --build --preset portable --target foretouch_c >&2
  mkdir -p build/godot
  rm -rf build/godot/addons
  cp -r $package/demo/. build/godot/
  mkdir build/godot/addons
  cp -r $package/addons/foretouch build/godot/addons/
  $package/build.sh build/portable/bindings/c build/godot/addons/foretouch
  echo "build/godot is a project for Godot 3: copy its addons/foretouch into yours"
}

shift  # the task
case "${1:-}" in
  --addon)
    make_addon
    exit
    ;;
  '' | --cost | --hands) ;;
  *) echo "run: godot: expected --addon, --cost or --hands, found '$1'" >&2; exit 2 ;;
esac
install_group godot
configure release -DFORETOUCH_BENCH=ON
cmake --build --preset release --target foretouch_c foretouch foretouch-import example >&2
exec $package/tests/godot_test.sh build/release/bindings/c build/release/bin/foretouch-import \
  build/release/share/foretouch/examples "$@"

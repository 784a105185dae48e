#!/usr/bin/env bash
# godot.sh godot [--cost|--hands [N]]: the add-on for Godot, put together, and tested in it.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

shift  # the task
install_group godot
build release >&2
built=(build/release/bindings/c build/release/bin/foretouch-import build/release/share/foretouch/examples)
mkdir -p build/godot/addons
rm -rf build/godot/addons/foretouch
cp -r integrations/godot/addons/foretouch build/godot/addons/
integrations/godot/build.sh "${built[0]}" build/godot/addons/foretouch
echo "godot: build/godot/addons/foretouch"
exec integrations/godot/tests/godot_test.sh "${built[@]}" "$@"

#!/usr/bin/env bash
# blender.sh blender [--measure]: the add-on for Blender, packed, and tested inside it.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

shift  # the task
install_group blender
build release >&2
mkdir -p build/blender
python3 - <<'PACK'
import pathlib, zipfile
folder = pathlib.Path("integrations/blender/foretouch_blender")
with zipfile.ZipFile("build/blender/foretouch_blender.zip", "w", zipfile.ZIP_DEFLATED) as archive:
    for file in sorted(folder.glob("*.py")):
        archive.writestr(zipfile.ZipInfo(f"{folder.name}/{file.name}"), file.read_bytes())
    archive.writestr(zipfile.ZipInfo(f"{folder.name}/LICENSE"), pathlib.Path("LICENSE").read_bytes())
PACK
echo "blender: build/blender/foretouch_blender.zip"
tests=integrations/blender/tests
if [ "${1:-}" = --measure ]; then exec "$tests/run.sh" build/release measure; fi
for suite in "$tests"/test_*.py; do
  "$tests/run.sh" build/release "$(basename "$suite" .py)"
done
"$tests/run.sh" build/release window

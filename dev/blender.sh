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


def add(archive, name, file):  # without its date: the same sources are the same bytes
    archive.writestr(zipfile.ZipInfo(f"{folder.name}/{name}"), file.read_bytes(), zipfile.ZIP_DEFLATED)


with zipfile.ZipFile("build/blender/foretouch_blender.zip", "w") as archive:
    for file in sorted(folder.glob("*.py")):
        add(archive, file.name, file)
    add(archive, "LICENSE", pathlib.Path("LICENSE"))
PACK
echo "blender: build/blender/foretouch_blender.zip"
tests=integrations/blender/tests
if [ "${1:-}" = --measure ]; then exec "$tests/run.sh" build/release measure; fi
for suite in "$tests"/test_*.py; do
  "$tests/run.sh" build/release "$(basename "$suite" .py)"
done
"$tests/run.sh" build/release window

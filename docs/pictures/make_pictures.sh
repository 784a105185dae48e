#!/usr/bin/env bash
# Draws the pictures of docs/ from the bundled example, by the built program: make_pictures.sh FORETOUCH
set -euo pipefail
program=$(realpath "$1")
pictures=$(cd "$(dirname "$0")" && pwd)
example=$(realpath "$(dirname "$program")/../share/foretouch/examples")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 "$pictures/concepts.py"
for picture in table_and_cup solid_tick hand_that_stops touches proven_edges; do
  PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$(realpath "$(dirname "$program")/../lib/python3/dist-packages")" \
    /usr/bin/python3 "$pictures/$picture.py"  # numpy is that of Debian's own Python
done
PYTHONDONTWRITEBYTECODE=1 python3 "$pictures/colliders.py" "$program"
PYTHONDONTWRITEBYTECODE=1 python3 "$pictures/engines.py" "$(dirname "$program")/.."
cd "$work"
"$program" demo --output demo.jsonl --report demo.html >/dev/null
inputs=(--scene "$example/room.obj" --avatar "$example/dancer.avatar.json" --motion "$example/dancer.bvh")
"$program" view "${inputs[@]}" --output look.html >/dev/null
"$program" view "${inputs[@]}" --scene-scale 0.01 --output wrong.html >/dev/null
PYTHONDONTWRITEBYTECODE=1 python3 "$pictures/report_pictures.py" demo.html look.html wrong.html "$pictures"
PYTHONDONTWRITEBYTECODE=1 python3 "$pictures/page_moves.py" demo.html "$pictures"
FORETOUCH_PACKAGES="$(realpath "$(dirname "$program")/../lib/python3/dist-packages")" PYTHONDONTWRITEBYTECODE=1 \
  /usr/bin/python3 "$pictures/blender.py" "$pictures"
ls -l "$pictures"/*.png

#!/usr/bin/env bash
# oracle.sh READ_MODEL FORETOUCH EXAMPLES SCRATCH [ARGS of oracle.mjs...]: over the files that are named,
# and the bundled example as the program writes it. Exit code 77 where node or its packages are absent.
set -euo pipefail
read_model=$1 foretouch=$2 examples=$3 scratch=$4
shift 4
here=$(dirname "$0")
if ! command -v node >/dev/null || [ ! -d "$here/node_modules/three" ]; then
  echo "node or its packages are absent: ./run gltf-oracle installs them" >&2
  exit 77
fi
mkdir -p "$scratch"
"$foretouch" replay --scene "$examples/room.obj" --avatar "$examples/dancer.avatar.json" \
  --motion "$examples/dancer.bvh" --rate 1 --glb "$scratch/dancer.glb" --glb-triangles 2000 \
  --output "$scratch/dancer.jsonl" >/dev/null 2>&1
node "$here/oracle.mjs" "$read_model" "$foretouch" "$examples" "$@" "$scratch/dancer.glb"

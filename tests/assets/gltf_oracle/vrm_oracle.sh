#!/usr/bin/env bash
# vrm_oracle.sh READ_MODEL WRITE_VRM SCRATCH [FILE...]: over the small avatars of the tests, and the
# files that are named; and over each with its avatar's LSS as colliders, where $FORETOUCH is the
# program. Exit code 77 where node or its packages are absent.
set -euo pipefail
read_model=$1 write_vrm=$2 scratch=$3
shift 3
here=$(dirname "$0")
if ! command -v node >/dev/null || [ ! -d "$here/node_modules/@pixiv/three-vrm" ]; then
  echo "node or its packages are absent: ./run gltf-oracle installs them" >&2
  exit 77
fi
mkdir -p "$scratch"
"$write_vrm" "$scratch"
files=("$scratch/vrm_0.vrm" "$scratch/vrm_1.vrm" "$@")
if [ -n "${FORETOUCH:-}" ]; then
  for file in "${files[@]}"; do
    name=$scratch/$(basename "$file" .vrm)
    "$FORETOUCH" avatar mesh "$file" -o "$name.json" --quiet >/dev/null
    "$FORETOUCH" avatar colliders "$name.json" --into "$file" -o "$name.more.vrm" --quiet >/dev/null
    files+=("$name.more.vrm")
  done
fi
node "$here/vrm_oracle.mjs" "$read_model" "${files[@]}"

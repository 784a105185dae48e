#!/usr/bin/env bash
# vrm_oracle.sh READ_MODEL WRITE_VRM SCRATCH [FILE...]: over the small avatars of the tests, and the
# files that are named. Exit code 77 where node or its packages are absent.
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
node "$here/vrm_oracle.mjs" "$read_model" "$scratch/vrm_0.vrm" "$scratch/vrm_1.vrm" "$@"

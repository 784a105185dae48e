#!/usr/bin/env bash
# judge.sh TASK [ARGS...]: judges at length what tests judge in short, by code that shares nothing
# with what it judges. The tasks: tasks.txt.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

# What is built, and runs with the arguments.
declare -rA programs=(
  [oracle]=oracle_sweep
  [solid-oracle]=solid_oracle
  [solid-world-oracle]=solid_world_oracle
  [world-oracle]=world_oracle
  [world-fuzz]=world_fuzz
  [leaf-oracle]=leaf_campaign
  [simulate]=stream_simulator
  [kill-trials]=log_kill_trials
  [certificate-trials]=certificate_trials
)

gltf_oracle() {  # gltf_oracle [--record]
  local data=${FORETOUCH_DATA:-../shared/data} files=() record=()
  case "${1:-}" in
    --record) record=(--record "$measurements/gltf.json") ;;
    ?*) echo "run: gltf-oracle: expected --record, found '$1'" >&2; exit 2 ;;
  esac
  command -v npm >/dev/null || install_missing nodejs npm
  install_gltf_packages
  if [ -d "$data" ]; then
    mapfile -d '' files < <(find "$data" \( -name '*.glb' -o -name '*.gltf' \) -print0 | sort -z)
  else
    echo "run: no $data: the bundled example alone is compared" >&2
  fi
  tests/assets/gltf_oracle/oracle.sh build/release/bin/read_model build/release/bin/foretouch \
    build/release/share/foretouch/examples build/release/gltf-oracle "${record[@]}" "${files[@]}"
}

moments() {  # moments FOLDER SCENE AVATAR REPLAY OPTIONS...
  if [ $# -lt 4 ]; then echo "run: moments: expected a folder, a scene, an avatar and options of replay" >&2; exit 2; fi
  local folder=$1 files=(--scene "$2" --avatar "$3")
  shift 3
  mkdir -p "$folder"
  "${FORETOUCH:-build/release/bin/foretouch}" replay "${files[@]}" --solid -q -o "$folder/shown.jsonl" "$@" >/dev/null
  build/release/bin/solid_moments "$folder/shown.jsonl" "${files[@]}" --output "$folder"
  PYTHONDONTWRITEBYTECODE=1 python3 docs/pictures/moment_strips.py "$folder"
}

task=$1
shift
case "$task" in
  moments)
    build_tests >&2
    moments "$@"
    ;;
  ask-oracle)
    if [ "${1:-}" = --sum ]; then exec python3 tests/oracle/asked.py "${@:2}"; fi
    build_tests >&2
    exec build/release/bin/ask_oracle "$@"
    ;;
  gltf-oracle)
    build_tests >&2
    gltf_oracle "$@"
    ;;
  batch-trials)
    build_tests
    exec python3 tests/tools/batch/batch_trials.py build/release/bin/foretouch "$@"
    ;;
  fleet-trials)
    install_group fleet
    build_tests
    ctest --preset release -R '^batch_by_' --output-on-failure
    ;;
  plans)
    build_tests -DFORETOUCH_OMPL=ON
    exec build/release/bin/plan_oracle "$@"
    ;;
  edges)
    build_tests -DFORETOUCH_OMPL=ON -DFORETOUCH_PEERS=ON
    exec build/release/bin/edge_peers "$@"
    ;;
  *)
    build_tests
    exec "build/release/bin/${programs[$task]}" "$@"
    ;;
esac

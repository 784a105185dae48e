#!/usr/bin/env bash
# fuzz.sh fuzz [--record] [SECONDS | --hours N] [TARGET...]: libFuzzer at every boundary.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

# TARGET=DICTIONARY; nothing: none.
readonly fuzz_targets=(bvh=bvh avatar=avatar pairs=pairs csv= joint_map= skeleton_message=message
                       pose_message=message contacts_message=message solid_message=message
                       person_message=message
                       speaker_message=message status_message=message body_message=message
                       rigid_pose_message=message events_message=message pushes_message=message
                       config=config project=config world_file=world rigid_poses= url=
                       shown_poses=shown_poses datagram=datagram http=
                       log=log log_damage=log baked_scene= import_stream= gltf= calls= manifest= certificate=)

fuzz_one() {  # fuzz_one TARGET DICTIONARY SECONDS: its log; false where it found something
  # Of what covers much (calls), the upkeep of libFuzzer's entropic schedule costs six times the calls.
  local target=$1 options=(-max_total_time="$3" -max_len=65536 -print_final_stats=1 -entropic=0)
  mkdir -p "build/fuzz/corpus-$target" "build/fuzz/findings"
  if [ -n "$2" ]; then options+=(-dict="tests/fuzz/$2.dict"); fi
  # Long traces of every allocation cost a third of all time; what broke something is run again with them.
  ASAN_OPTIONS=${ASAN_OPTIONS:-malloc_context_size=4:quarantine_size_mb=16} \
    "build/fuzz/bin/fuzz_$target" "${options[@]}" -artifact_prefix="build/fuzz/findings/$target-" \
    "build/fuzz/corpus-$target" "tests/fuzz/corpus/$target" >"build/fuzz/$target.log" 2>&1
}

fuzz_all() {  # fuzz_all [--record] [SECONDS | --hours N] [TARGET...]
  local seconds=60 hours='' entry target chosen=() found=() record=()
  if [ "${1:-}" = --record ]; then record=(--record "$measurements/fuzzing.json"); shift; fi
  case "${1:-}" in
    --hours) hours=${2:?"run: fuzz: expected a number behind --hours"}; shift 2 ;;
    [0-9]*) seconds=$1; shift ;;
  esac
  for entry in "${fuzz_targets[@]}"; do
    if [ $# -eq 0 ] || [[ " $* " == *" ${entry%%=*} "* ]]; then chosen+=("$entry"); fi
  done
  if [ ${#chosen[@]} -eq 0 ]; then echo "run: fuzz: expected some of ${fuzz_targets[*]%%=*}, found '$*'" >&2; exit 2; fi
  if [ -n "$hours" ]; then seconds=$(awk -v h="$hours" -v n=${#chosen[@]} 'BEGIN { print int(h * 3600 / n) }'); fi
  local names=("${chosen[@]%%=*}")
  cmake --build --preset fuzz --target "${names[@]/#/fuzz_}"
  for entry in "${chosen[@]}"; do
    target=${entry%%=*}
    echo "run: fuzz: $target, $seconds s" >&2
    fuzz_one "$target" "${entry##*=}" "$seconds" || { found+=("$target"); tail -n 20 "build/fuzz/$target.log" >&2; }
  done
  python3 tests/fuzz/executions.py "${record[@]}" build/fuzz "${names[@]}"
  if [ ${#found[@]} -gt 0 ]; then
    echo "run: fuzz: broken: ${found[*]}; inputs in build/fuzz/findings" >&2
    exit 1
  fi
}

shift  # the task
install_group fuzz
configure fuzz -DFORETOUCH_TOOLS=OFF
fuzz_all "$@"

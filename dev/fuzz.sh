#!/usr/bin/env bash
# fuzz.sh fuzz [--record] [SECONDS | --hours N] [TARGET...]: libFuzzer at every boundary.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

# Each folder of the corpus is a target's.
readonly fuzz_targets=($(ls tests/fuzz/corpus))

dictionary_of() {  # dictionary_of TARGET: its file, or nothing
  local name
  for name in "$1" "${1##*_}" "${1%%_*}"; do
    [ "$name" != project ] || name=config
    if [ -e "tests/fuzz/$name.dict" ]; then echo "tests/fuzz/$name.dict"; return; fi
  done
}

fuzz_one() {  # fuzz_one TARGET SECONDS: its log; false where it found something
  # Of what covers much (calls), the upkeep of libFuzzer's entropic schedule costs six times the calls.
  local target=$1 dictionary options=(-max_total_time="$2" -max_len=65536 -print_final_stats=1 -entropic=0)
  mkdir -p "build/fuzz/corpus-$target" "build/fuzz/findings"
  dictionary=$(dictionary_of "$target")
  if [ -n "$dictionary" ]; then options+=(-dict="$dictionary"); fi
  # Long traces of every allocation cost a third of all time; what broke something is run again with them.
  ASAN_OPTIONS=${ASAN_OPTIONS:-malloc_context_size=4:quarantine_size_mb=16} \
    "build/fuzz/bin/fuzz_$target" "${options[@]}" -artifact_prefix="build/fuzz/findings/$target-" \
    "build/fuzz/corpus-$target" "tests/fuzz/corpus/$target" >"build/fuzz/$target.log" 2>&1
}

fuzz_all() {  # fuzz_all [--record] [SECONDS | --hours N] [TARGET...]
  local seconds=60 hours='' target chosen=() found=() record=()
  if [ "${1:-}" = --record ]; then record=(--record "$measurements/fuzzing.json"); shift; fi
  case "${1:-}" in
    --hours) hours=${2:?"run: fuzz: expected a number behind --hours"}; shift 2 ;;
    [0-9]*) seconds=$1; shift ;;
  esac
  for target in "${fuzz_targets[@]}"; do
    if [ $# -eq 0 ] || [[ " $* " == *" $target "* ]]; then chosen+=("$target"); fi
  done
  if [ ${#chosen[@]} -eq 0 ]; then echo "run: fuzz: expected some of ${fuzz_targets[*]}, found '$*'" >&2; exit 2; fi
  if [ -n "$hours" ]; then seconds=$(awk -v h="$hours" -v n=${#chosen[@]} 'BEGIN { print int(h * 3600 / n) }'); fi
  cmake --build --preset fuzz --target "${chosen[@]/#/fuzz_}"
  for target in "${chosen[@]}"; do
    echo "run: fuzz: $target, $seconds s" >&2
    fuzz_one "$target" "$seconds" || { found+=("$target"); tail -n 20 "build/fuzz/$target.log" >&2; }
  done
  python3 tests/fuzz/executions.py "${record[@]}" build/fuzz "${chosen[@]}"
  if [ ${#found[@]} -gt 0 ]; then
    echo "run: fuzz: broken: ${found[*]}; inputs in build/fuzz/findings" >&2
    exit 1
  fi
}

shift  # the task
install_group fuzz
configure fuzz
fuzz_all "$@"

#!/usr/bin/env bash
# cross.sh cross arm64|wasm|windows [--record]: the library and its tests on another machine.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh
. dev/machines.sh

# The tests that run there (docs/machines.md says which do not).
cross_tests=(lss_tests articulated_tests tessellation_tests scene_tests assets_tests bindings_tests)

# One program's tests, a share on each core. Adds to `passed`.
tests_elsewhere() {  # tests_elsewhere MACHINE PROGRAM EMULATOR...
  local program=$2 shares shard failed=0 log=build/cross/$1/$2.log
  local command=("${@:3}" "build/cross/$1/bin/$2")
  shares=$(nproc)
  local running=() logs=() began=$SECONDS
  for ((shard = 0; shard < shares; ++shard)); do
    GTEST_COLOR=no GTEST_TOTAL_SHARDS=$shares GTEST_SHARD_INDEX=$shard "${command[@]}" >"$log.$shard" 2>&1 &
    running+=($!)
    logs+=("$log.$shard")
  done
  for shard in "${running[@]}"; do wait "$shard" || failed=1; done
  if [ "$failed" = 1 ]; then grep -hv '^\[ RUN\|^\[       OK' "${logs[@]}"; fi
  shares=$(sed -n 's/^\[  PASSED  \] \([0-9]*\) test.*/\1/p' "${logs[@]}" | awk '{n += $1} END {print n + 0}')
  passed=$((passed + shares))
  echo "$program: $shares passed in $((SECONDS - began)) s"
  sed -n 's/^\[  SKIPPED \] \([^ ]*\) (.*/  skipped: \1/p' "${logs[@]}"
  return "$failed"
}

# Does another machine answer as this one does? The bundled clips, and those of data/mocap where they are.
same_verdicts() {  # same_verdicts MACHINE PROGRAM EMULATOR...
  local examples=$PWD/build/release/share/foretouch/examples folder=build/cross/verdicts failed=0
  local data=${FORETOUCH_DATA:-$PWD/../shared/data} cases=$folder/cases other=$folder/$1 pair
  configure release -DFORETOUCH_TESTS=ON -DFORETOUCH_BENCH=ON
  cmake --build --preset release --target verdicts make_cases judge_verdicts example || return 1
  mkdir -p "$folder"
  for pair in "room dancer" "desk hand"; do
    printf '%s\t%s\t%s\t3\t1\t0\t0\t0\t0\n' \
      "$examples/${pair% *}.obj" "$examples/${pair#* }.avatar.json" "$examples/${pair#* }.bvh"
  done >"$cases"
  if [ -d "$data/mocap" ]; then
    build/release/bin/make_cases "$examples/room.obj" "$data" "$folder/clips" || return 1
    cat "$folder/clips/cases" >>"$cases"
  else
    echo "run: no $data/mocap: the bundled clips alone are compared" >&2
  fi
  build/release/bin/verdicts "$cases" >"$folder/here" || return 1
  "${@:3}" "build/cross/$1/bin/$2" "$cases" >"$other" || return 1
  python3 tests/cross/compare.py "$folder/here" "$other" || failed=1
  for pair in "$folder/here" "$other"; do
    echo -n "the judge on $(basename "$pair"): "
    build/release/bin/judge_verdicts "$cases" "$pair" || failed=1
  done
  return "$failed"
}

# The library for another machine, in build/cross/, and its tests.
cross() {  # cross MACHINE [--record]
  local machine=${1:-} program failed=0 passed=0
  local emulator suffix
  prepare_cross "$machine"
  case "${2:---record}" in --record) ;; *) echo "run: cross: expected --record, found '$2'" >&2; exit 2 ;; esac
  configure "$machine"
  cmake --build --preset "$machine" --target foretouch_c verdicts "${cross_tests[@]}"
  for program in "${cross_tests[@]}"; do
    tests_elsewhere "$machine" "$program$suffix" "${emulator[@]}" || failed=1
  done
  same_verdicts "$machine" "verdicts$suffix" "${emulator[@]}" || failed=1
  if [ "${2:-}" = --record ] && [ "$failed" = 0 ]; then
    python3 tests/cross/compare.py build/cross/verdicts/{here,"$machine"} "$measurements/machines.json" "$machine" "$passed"
  fi
  echo "cross $machine: $passed tests passed$([ "$failed" = 0 ] || echo ', something failed')"
  return "$failed"
}

shift  # the task
cross "$@"

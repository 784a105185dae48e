#!/usr/bin/env bash
# measure.sh bench|peers|soak|instructions|roofline [ARGS...]: speed, and what costs it.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

measure() {  # measure NAME ARGS...: one benchmark, its figures kept under NAME
  local name=$1
  shift
  echo "run: $name" >&2
  build/release/bin/foretouch-bench "$@" --json "$measurements/$name.json" --csv "build/release/$name.csv"
}

bench_all() {
  local latency=(latency --steps 500) scaling=(scaling --steps 500 --repeat 5) stream=(stream) peers=(peers)
  local deadline=(deadline --lift 0.0012 --choice mix --asks 250000 --steps 500)
  local solid=(solid --parts scenes --rates 90,30 --explain) trials=(solid --parts boards,clutter,slide,press,fingers)
  local board=(solid --parts board --board-trials 1000000)
  local world=(world)
  if [ "${1:-}" = --quick ]; then
    latency=(latency --steps 100 --repeat 3)
    scaling=(scaling --quick)
    stream=(stream --seconds 2)
    deadline=(deadline --lift 0.0012 --choice mix --asks 10000 --steps 100)
    peers=(peers --motions 100)
    solid+=(--places 1 --seconds 1)
    trials+=(--goals 100)
    board=(solid --parts board --board-trials 1000)
    world+=(--avatars 2,30,300 --pairs 200 --windows 10)
  fi
  mkdir -p "$measurements"
  measure latency-room "${latency[@]}" --triangles 300000 --links 16
  measure latency-mix "${latency[@]}" --triangles 300000 --links 16 --choice mix --simd widest
  # The kitchen and its clip are no part of the project: their figures stay as they were where they are absent.
  local data=${FORETOUCH_DATA:-../shared/data}
  local kitchen=$data/scenes/kitchen_fatihrmutfak.ply clip=$data/mocap/bandai1_kick_normal_001.bvh
  if [ -f "$kitchen" ] && [ -f "$clip" ]; then
    measure latency-kitchen "${latency[@]}" --scene "$kitchen" --scene-up z --motion "$clip" --clip-scale 0.01
  fi
  measure latency-exact "${latency[@]}" --fidelity exact --links 15 --simd widest
  measure latency-own "${latency[@]}" --self --place 0,0,0 --simd widest
  measure scaling "${scaling[@]}"
  measure deadline "${deadline[@]}"
  measure stream "${stream[@]}"
  measure peers "${peers[@]}"
  # The bundled room always; furniture that is no part of the project where it is at hand.
  [ -d "$data/scenes" ] || solid+=(--scenes room)
  measure solid "${solid[@]}"
  measure solid-board "${board[@]}"
  measure solid-trials "${trials[@]}"
  # By clips that are no part of the project, or by the bundled dancer.
  measure world "${world[@]}"
}

# Callgrind counts what the benchmark's answerStep() costs, and nothing else: the same on a busy machine as on an idle
# one. Its whole name: the kernel has one within it, which would end the count. Valgrind knows no AVX-512.
count_instructions() {
  local folder=build/release/instructions
  mkdir -p "$folder" "$measurements"
  # Valgrind does not let a program lower the limit of open files that it inherits; the importer's is 64.
  (ulimit -n 64; valgrind --tool=callgrind --collect-atstart=no '--toggle-collect=foretouch::tools::answerStep*' \
    --callgrind-out-file="$folder/callgrind.out" build/release/bin/foretouch-bench latency --place 0,0,0 --rate 15 \
    --tolerance 0.001 --simd avx2 --repeat 1 --cold-mb 0 --json "$folder/latency.json" \
    >"$folder/log" 2>&1) || { cat "$folder/log" >&2; exit 1; }
  build/release/bin/foretouch-bench instructions --callgrind "$folder/callgrind.out" \
    --latency "$folder/latency.json" --recorded "$measurements/instructions.json" "$@"
}

task=$1
shift
case "$task" in
  bench)
    build release -DFORETOUCH_BENCH=ON -DFORETOUCH_PEERS=ON >&2
    bench_all "$@"
    ;;
  peers)
    build release -DFORETOUCH_BENCH=ON -DFORETOUCH_PEERS=ON >&2
    exec build/release/bin/foretouch-bench peers "$@"
    ;;
  soak)
    build release -DFORETOUCH_BENCH=ON >&2
    exec build/release/bin/foretouch-bench soak "$@"
    ;;
  instructions)
    install_group instructions
    build release -DFORETOUCH_BENCH=ON >&2
    count_instructions "$@"
    ;;
  roofline)
    install_group instructions
    build release -DFORETOUCH_BENCH=ON >&2
    exec env PYTHONDONTWRITEBYTECODE=1 python3 dev/roofline.py build/release/bin/foretouch-bench \
      build/release/roofline "$measurements/roofline.json" "$@"
    ;;
esac

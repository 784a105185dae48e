#!/bin/bash
# parallel_test.sh PROGRAM LAUNCHER TRIALS: a batch by GNU parallel, killed in its midst and started
# again, leaves what one undisturbed run leaves. 77: GNU parallel is not installed.
set -eu
program=$1 launcher=$2 trials=$3
if ! parallel --version 2>/dev/null | grep -q '^GNU parallel'; then
  echo "[  SKIPPED ] GNU parallel is not installed (Debian: parallel)"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 "$trials" --make "$folder" --jobs 24
code=0
"$program" batch "$folder/fleet.batch" --output "$folder/alone" --quiet >/dev/null 2>&1 || code=$?
[ $code = 1 ] || { echo "expected exit code 1 for the missing clip, found $code"; exit 1; }
"$program" batch "$folder/fleet.batch" --output "$folder/alone" --merge >/dev/null || true

export FORETOUCH=$program
setsid "$launcher" "$folder/fleet.batch" "$folder/many" --shards 5 -- --jobs 2 >/dev/null 2>&1 &
sleep 1
kill -9 -- -$! 2>/dev/null || echo "it was done before the kill"
wait || true
"$launcher" "$folder/fleet.batch" "$folder/many" --shards 5 -- --jobs 2 2>/dev/null || code=$?
[ $code = 1 ] || { echo "expected exit code 1, found $code"; exit 1; }
cmp "$folder/alone/table.csv" "$folder/many/table.csv"
cmp "$folder/alone/report.html" "$folder/many/report.html"
[ "$(awk 'NR > 1' "$folder/many/parallel.log" | wc -l)" -ge 5 ] || { echo "parallel ran no shards"; exit 1; }
code=0
"$launcher" "$folder/fleet.batch" "$folder/many" --shards 0 2>/dev/null || code=$?
[ $code = 2 ] || { echo "expected exit code 2 for no shards, found $code"; exit 1; }
echo "24 jobs in 5 shards, killed once: the same table and report"

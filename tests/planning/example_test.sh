#!/bin/sh
# example_test.sh PLAN_ARM DATA ROBOT FORETOUCH: plans for a robot of the shared data, and shows the way
# in a report, where it meets nothing, and in a certificate, which proves it; skipped where the data is absent.
set -e
program=$1 file=${FORETOUCH_DATA:-$2}/robots/$3 foretouch=$4
if [ ! -f "$file" ]; then
  echo "skipped: shared data absent: robots/$3"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$program" "$file" 8 "$folder" | tail -n 1 | grep 'keeps 5 mm: proven'
if [ ! -x "$foretouch" ]; then exit 0; fi  # built without the tools
cd "$folder"
"$foretouch" avatar urdf "$file" -o arm.json
"$foretouch" replay --scene poles.obj --scene-up z --avatar arm.json --motion plan.csv --robot "$file" \
  --output plan.jsonl --report plan.html
tail -n 1 plan.jsonl | grep '"touches":0,'
test -s plan.html
"$foretouch" certify --scene poles.obj --scene-up z --avatar arm.json --motion plan.csv --robot "$file" \
  --output proof
"$foretouch-verify" proof/scene.obj proof/avatar.json proof/steps.txt proof/certificate.txt --whole

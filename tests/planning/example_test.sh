#!/bin/sh
# example_test.sh PLAN_ARM DATA ROBOT: plans for a robot of the shared data; skipped where it is absent.
program=$1 file=${FORETOUCH_DATA:-$2}/robots/$3
if [ ! -f "$file" ]; then
  echo "skipped: shared data absent: robots/$3"
  exit 77
fi
"$program" "$file" 3 | tail -n 1 | grep 'keeps 5 mm: proven'

#!/usr/bin/env bash
# docs/performance.md is, byte for byte, what `./run bench` makes of the files in docs/measurements/.
#   performance_test.sh FORETOUCH_BENCH SOURCE_FOLDER
set -euo pipefail
bench=$1 source=$2
made=$(mktemp)
trap 'rm -f "$made"' EXIT
# `dev/measure.sh` says which files, in which order.
names=$(sed -n '/^readonly performance_figures="/,/"$/p' "$source/dev/measure.sh" | sed 's/.*="//; s/"$//')
files=()
for name in $names; do
  file=$source/docs/measurements/$name.json
  if [ -f "$file" ]; then files+=("$file"); fi
done
[ ${#files[@]} -ge 5 ] || { echo "dev/measure.sh names ${#files[@]} files for docs/performance.md"; exit 1; }
"$bench" report "${files[@]}" --output "$made"
diff "$source/docs/performance.md" "$made"

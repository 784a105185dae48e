#!/usr/bin/env bash
# Installs the build into a folder of its own and builds the README's library example against it with
# find_package, as somebody else's project would.
#   consumer_test.sh CMAKE BUILD_FOLDER SOURCE_FOLDER COMPILER GENERATOR
set -euo pipefail
cmake=$1 build=$2 source=$3 compiler=$4 generator=$5
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$cmake" --install "$build" --prefix "$folder/prefix" >"$folder/install.log"
"$cmake" -G "$generator" -S "$source/tests/consumer" -B "$folder/build" -DCMAKE_PREFIX_PATH="$folder/prefix" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release
"$cmake" --build "$folder/build"
"$folder/build/consumer"
# The program works from where it was installed: it finds its importer and its example.
if [ -x "$folder/prefix/bin/foretouch" ]; then
  cd "$folder"
  "$folder/prefix/bin/foretouch" demo --output demo.jsonl >demo.txt
  grep -q '"format":"foretouch-results"' demo.jsonl
fi

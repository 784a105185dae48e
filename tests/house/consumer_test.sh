#!/usr/bin/env bash
# Installs the build into a folder of its own and builds examples against it as somebody else's
# projects would: the README's in C++ with find_package, the one in C with find_package and with
# pkg-config.
#   consumer_test.sh CMAKE BUILD_FOLDER SOURCE_FOLDER CXX_COMPILER GENERATOR C_COMPILER [SANITIZERS]
set -euo pipefail
cmake=$1 build=$2 source=$3 cxx=$4 generator=$5 cc=$6
# Whoever links what is built with sanitizers needs their libraries.
if [ -n "${7:-}" ]; then
  export CFLAGS=-fsanitize=$7 CXXFLAGS=-fsanitize=$7 LDFLAGS=-fsanitize=$7
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
prefix=$folder/prefix
"$cmake" --install "$build" --prefix "$prefix" >"$folder/install.log"

consume() {  # consume NAME SOURCES CMAKE_OPTIONS...
  local name=$1 sources=$2
  shift 2
  "$cmake" -G "$generator" -S "$sources" -B "$folder/$name" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release "$@"
  "$cmake" --build "$folder/$name"
}

# The kernel stands alone: who asks queries links no file formats, no JSON, and starts no processes.
expect_kernel_alone() {  # expect_kernel_alone PROGRAM
  local linked started
  linked=$(ldd "$1" | grep -E 'fmt|assimp|urdfdom|tinyxml|lcm|httplib' || true)
  started=$(nm --undefined-only "$1" | grep -wE 'fork|vfork|execv|execve|execvp|posix_spawn|socket' || true)
  if [ -n "$linked$started" ]; then
    printf 'A program that links foretouch::middleware alone has more:\n%s\n%s\n' "$linked" "$started" >&2
    exit 1
  fi
}

# The reference room (middleware/reference/) is for tests and benchmarks: what is installed has none
# of its functions, and no header to ask for them.
expect_no_reference() {  # expect_no_reference FILE...
  local room file shared
  room=$(find "$build" -name 'libforetouch_reference.*' | head -n 1)
  [ -n "$room" ] || return 0  # neither tests nor benchmarks were built
  nm --defined-only "$room" | awk '$2 == "T" { print $3 }' | sort -u >"$folder/reference.txt"
  [ "$(wc -l <"$folder/reference.txt")" -gt 20 ] || { echo "$room defines nothing" >&2; exit 1; }
  for file in "$@"; do
    shared=$(nm "$file" | awk '{ print $NF }' | sort -u | comm -12 - "$folder/reference.txt")
    if [ -n "$shared" ]; then
      printf '%s has functions of the reference room:\n%s\n' "$file" "$shared" >&2
      exit 1
    fi
  done
  if [ -e "$prefix/include/foretouch/middleware/reference" ]; then
    echo "headers of the reference room are installed" >&2
    exit 1
  fi
}

consume consumer "$source/tests/consumer" -DCMAKE_CXX_COMPILER="$cxx"
expect_kernel_alone "$folder/consumer/consumer"
products=()
for product in bin/foretouch lib/libforetouch.so bindings/c/libforetouch.so; do
  if [ -f "$build/$product" ]; then products+=("$build/$product"); fi
done
expect_no_reference "$folder/consumer/consumer" "${products[@]}"
"$folder/consumer/consumer" | tee "$folder/cxx.txt"

if [ -f "$prefix/include/foretouch/foretouch.h" ]; then
  consume swing "$prefix/share/foretouch/c-example" -DCMAKE_C_COMPILER="$cc"
  "$folder/swing/swing" | tee "$folder/c.txt"
  # The same question, the same answer.
  cmp "$folder/cxx.txt" <(head -n 1 "$folder/c.txt")
  "$folder/swing/table"

  library=$(dirname "$(find "$prefix" -name libforetouch.so)")
  read -ra flags <<<"$(PKG_CONFIG_PATH=$library/pkgconfig pkg-config --cflags --libs foretouch)"
  for program in "$prefix"/share/foretouch/c-example/*.c "$source/tests/consumer/import.c"; do
    "$cc" -std=c99 -pedantic -Wall -Wextra -Werror "$program" ${CFLAGS:-} \
      -o "$folder/$(basename "$program" .c)-c" "${flags[@]}" -lm
  done
  export LD_LIBRARY_PATH=$library
  "$folder/swing-c" | cmp - "$folder/c.txt"
  printf 'v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n' >"$folder/scene.obj"
  "$folder/import-c" "$folder/scene.obj"
fi

# The program works from where it was installed: it finds its importer and its example.
if [ -x "$prefix/bin/foretouch" ]; then
  cd "$folder"
  "$prefix/bin/foretouch" demo --output demo.jsonl >demo.txt
  grep -q '"format":"foretouch-results"' demo.jsonl
fi

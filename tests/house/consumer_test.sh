#!/usr/bin/env bash
# Installs the build into a folder of its own and builds programs against it as somebody else's
# projects would: the README's in C++ with find_package, those in C with find_package and with
# pkg-config. They read files with the importer that lies in the same folder, wherever that is.
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

targets=()  # that are built; none: all
consume() {  # consume NAME SOURCES CMAKE_OPTIONS...
  local name=$1 sources=$2
  shift 2
  "$cmake" -G "$generator" -S "$sources" -B "$folder/$name" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release "$@"
  "$cmake" --build "$folder/$name" "${targets[@]}"
}

# The kernel stands alone: who asks queries links no file formats, no JSON, and starts no processes.
expect_kernel_alone() {  # expect_kernel_alone PROGRAM
  local linked started
  linked=$(ldd "$1" | grep -E 'fmt|assimp|urdfdom|mujoco|tinyxml|lcm|httplib' || true)
  started=$(nm --undefined-only "$1" | grep -wE 'fork|vfork|execv|execve|execvp|posix_spawn|socket' || true)
  if [ -n "$linked$started" ]; then
    printf 'A program that links foretouch::middleware alone has more:\n%s\n%s\n' "$linked" "$started" >&2
    exit 1
  fi
}

# The reference room (tests/reference/) is for tests and benchmarks: what is installed has none
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
  if [ -e "$prefix/include/foretouch/tests" ]; then
    echo "headers of the reference room are installed" >&2
    exit 1
  fi
}

# Nothing of ours but foretouch/ is in an include path, and headers find one another by that name.
expect_own_names() {
  local wrong header
  wrong=$(find "$prefix/include" -mindepth 1 -maxdepth 1 ! -name foretouch; grep -rn '#include "' "$prefix/include" || true)
  while read -r header; do
    if [ ! -f "$prefix/include/$header" ]; then wrong+=" $header is included, and not installed"; fi
  done < <(grep -rhoE '#include <foretouch/[^>]+' "$prefix/include" | sed 's/.*<//' | sort -u)
  if [ -n "$wrong" ]; then
    printf 'Installed headers:\n%s\n' "$wrong" >&2
    exit 1
  fi
  [ "$(find "$prefix/include" -name '*.h' | wc -l)" -gt 50 ]
}

# Each library can be asked for by its name, and what is not there is said.
expect_components() {  # expect_components PREFIX NAME
  local prefix=$1 component library built=cxx not_built=
  for component in lss articulated tessellation middleware assets network c; do
    library=libforetouch_$component
    if [ "$component" = c ]; then library=libforetouch; fi
    if [ -n "$(find "$prefix" -name "$library.so" -o -name "$library.a")" ]; then
      built+=";$component"
    else
      not_built+=";$component"
    fi
  done
  "$cmake" -G "$generator" -S "$source/tests/consumer/components" -B "$folder/$2" \
    -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" \
    -DBUILT="$built" -DNOT_BUILT="${not_built#;}" >"$folder/$2.log"
}

# Of a build that is not whole the installation says which targets to build, and which components are
# whole.
expect_what_to_build() {
  mkdir "$folder/partial"
  {
    echo "product(dev foretouch_lss \"$0\")"
    echo 'product(runtime foretouch /nowhere/foretouch)'
    echo 'product(c foretouch_c /nowhere/libforetouch.so)'
  } >"$folder/partial/products-Release.cmake"
  install_partial() {
    "$cmake" -Dbuild="$folder/partial" -Dproducts="$folder/partial/products" \
      -DCMAKE_INSTALL_CONFIG_NAME=Release "$@" \
      -P "$source/cmake/check_built.cmake" 2>&1
  }
  install_partial -DCMAKE_INSTALL_COMPONENT=dev
  if install_partial >"$folder/partial.txt"; then
    echo "a build that lacks two targets is taken for whole" >&2
    exit 1
  fi
  grep -q -- '--target foretouch foretouch_c$' "$folder/partial.txt"
  grep -q -- '--component dev$' "$folder/partial.txt"
  install_partial -DCMAKE_INSTALL_COMPONENT=c >"$folder/partial.txt" || true
  grep -q -- '--target foretouch_c$' "$folder/partial.txt"
}

expect_own_names
expect_what_to_build
expect_components "$prefix" components
"$cmake" --install "$build" --prefix "$folder/cxx" --component dev >"$folder/install-cxx.log"
expect_components "$folder/cxx" components-cxx
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
  "$folder/swing/solid_hand" | tee "$folder/solid-hand.txt"
  "$folder/swing/swinging_door" | tee "$folder/swinging-door.txt"

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

  # C#, where there is a compiler for it: the same question once more.
  if command -v mcs >/dev/null && command -v mono >/dev/null && [ -z "${7:-}" ]; then
    mcs -unsafe -langversion:latest -r:System.Core -out:"$folder/swing.exe" \
      "$prefix/share/foretouch/c-example/swing.cs" "$prefix"/share/foretouch/dotnet/Runtime/{,Native/,Engine/}*.cs
    mono "$folder/swing.exe" | cmp - <(head -n 1 "$folder/c.txt")
  else
    echo "left out: C#, which needs mcs and mono, and a library without sanitizers"
  fi
fi

# Whole programs, from files to a loop: the one in C++ finds the importer of the copy that it was
# built against, also of one that was moved, and nothing in the environment helps it.
unset FORETOUCH_IMPORTER
play_in_cxx() {  # play_in_cxx NAME: with the copy in $prefix; what it prints goes to NAME.txt
  local room=$prefix/share/foretouch/examples
  consume "$1" "$prefix/share/foretouch/cpp-example" -DCMAKE_CXX_COMPILER="$cxx"
  "$folder/$1/play_clip" "$room/room.obj" "$room/dancer.avatar.json" "$room/dancer.bvh" 6 >"$folder/$1.txt"
}
if [ -f "$prefix/share/foretouch/cpp-example/play_clip.cpp" ]; then
  play_in_cxx play
  tail -n 1 "$folder/play.txt"
  "$folder/play/game_loop"
  "$folder/play/hit_registration"
  "$folder/play/vr_hands" | tee "$folder/vr-hands.txt"
  # As JavaScript's are held to (bindings/wasm/tests).
  cmp "$folder/vr-hands.txt" "$source/tests/examples/vr_hands.txt"
  "$folder/play/swinging_door" | cmp - "$source/tests/examples/swinging_door.txt"
  if command -v python3 >/dev/null; then  # when hands meet and leave, by plain arithmetic on where they were shown
    "$folder/play/vr_hands" ways >"$folder/ways.txt"
    python3 "$source/tests/examples/vr_hands_judge.py" <"$folder/ways.txt"
    if grep -v "RightHand leaves door" "$folder/ways.txt" | python3 "$source/tests/examples/vr_hands_judge.py"; then
      echo "a hand that never leaves was taken for right" >&2
      exit 1
    fi
  else
    echo "left out: when hands meet and leave, which python3 judges"
  fi
  if [ -f "$folder/solid-hand.txt" ]; then "$folder/play/solid_hand" | cmp - "$folder/solid-hand.txt"; fi
  if [ -f "$folder/swinging-door.txt" ]; then "$folder/play/swinging_door" | cmp - "$folder/swinging-door.txt"; fi
  room=$prefix/share/foretouch/examples
  contacts=$(grep -c meets "$folder/play.txt")
  grep -qx "$contacts contacts in 136 steps" "$folder/play.txt"
  # Of each step in any order: C lists the earliest first, C++ link by link.
  if [ -x "$folder/play_clip-c" ]; then
    "$folder/play_clip-c" "$room/room.obj" "$room/dancer.avatar.json" "$room/dancer.bvh" 6 >"$folder/play-c.txt"
    cmp <(sort "$folder/play.txt") <(sort "$folder/play-c.txt")
  fi
  # And Python, from the same copy. What is built with sanitizers cannot be loaded as it is.
  packages=$prefix/lib/python3/dist-packages
  if [ -d "$packages/foretouch" ] && [ -z "${7:-}" ]; then
    PYTHONPATH=$packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$source/bindings/python/example/play_clip.py" \
      "$room/room.obj" "$room/dancer.avatar.json" "$room/dancer.bvh" 6 >"$folder/play-python.txt"
    cmp <(sort "$folder/play.txt") <(sort "$folder/play-python.txt")
    PYTHONPATH=$packages PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$source/bindings/python/example/swinging_door.py" \
      >"$folder/swinging-door-python.txt"
    if [ -f "$folder/swinging-door.txt" ]; then cmp "$folder/swinging-door.txt" "$folder/swinging-door-python.txt"; fi
  fi
  # What cannot be read is said: the file, and what was expected.
  if "$folder/play/play_clip" "$folder/nowhere.obj" "$room/dancer.avatar.json" "$room/dancer.bvh" 2>"$folder/error.txt"; then
    echo "a scene that does not exist was read" >&2
    exit 1
  fi
  grep -q 'nowhere.obj: cannot open the file' "$folder/error.txt"

  prefix=$folder/moved
  mv "$folder/prefix" "$prefix"
  targets=(--target play_clip)
  play_in_cxx play-moved
  targets=()
  cmp "$folder/play.txt" "$folder/play-moved.txt"
fi

# The program works from where it was installed: it finds its importer and its example.
if [ -x "$prefix/bin/foretouch" ]; then
  cd "$folder"
  "$prefix/bin/foretouch" demo --output demo.jsonl >demo.txt
  grep -q '"format":"foretouch-results"' demo.jsonl
fi

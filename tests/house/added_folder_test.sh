#!/usr/bin/env bash
# Somebody else's project adds this one as a folder (add_subdirectory, FetchContent): the same includes
# and targets as with an installed copy, and the importer of the build is known to its program.
#   added_folder_test.sh CMAKE SOURCE_FOLDER CXX_COMPILER
set -euo pipefail
cmake=$1 source=$2 cxx=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cat >"$folder/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.22)
project(somebody_elses LANGUAGES C CXX)
set(FORETOUCH_TOOLS OFF)
set(FORETOUCH_NETWORK OFF)
set(FORETOUCH_C OFF)
set(FORETOUCH_PYTHON OFF)
add_subdirectory($source foretouch)
add_executable(play_clip play_clip.cpp)
target_link_libraries(play_clip PRIVATE foretouch::assets)
END
cp "$source/examples/cpp/play_clip.cpp" "$folder"
# The libraries themselves are built elsewhere; what differs here is how their headers are found.
"$cmake" -G "Unix Makefiles" -S "$folder" -B "$folder/build" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >"$folder/log" || { cat "$folder/log" >&2; exit 1; }
command=$(grep '"command".*play_clip\.cpp' "$folder/build/compile_commands.json")
case "$command" in
  *FORETOUCH_PACKAGED_IMPORTER=*"$folder/build/foretouch/bin/foretouch-import"*) ;;
  *) echo "the importer of the build is not told: $command" >&2; exit 1 ;;
esac
make -s -C "$folder/build" -f CMakeFiles/play_clip.dir/build.make CMakeFiles/play_clip.dir/play_clip.cpp.o

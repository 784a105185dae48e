#!/usr/bin/env bash
# The C library for another machine, used as somebody would who builds a program for it here: the
# example `table` must tell what it tells on this machine.
#   try_machine.sh arm64|windows FOLDER INSTALLED_HERE EMULATOR...
set -euo pipefail
machine=$1 folder=$2 here=$3
shift 3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
say() { echo "try_machine: $*"; }
example=share/foretouch/c-example/table.c
case "$machine" in
  arm64)
    for package in "$folder"/*_arm64.deb; do
      [ "$(dpkg-deb -f "$package" Architecture)" = arm64 ]
      dpkg-deb -x "$package" "$scratch"
    done
    compiler=aarch64-linux-gnu-gcc prefix=$scratch/usr library=$scratch/usr/lib/aarch64-linux-gnu
    # Its own libraries are where the emulator finds those of Debian.
    sysroot=$(realpath "$folder/../sysroot-arm64")
    more=(-Wl,--allow-shlib-undefined -Wl,-rpath-link,"$sysroot/usr/lib/aarch64-linux-gnu")
    program=$scratch/table run=("$@" -E "LD_LIBRARY_PATH=$library")
    ;;
  windows)
    python3 -m zipfile -e "$folder"/foretouch-*.zip "$scratch"
    prefix=$(echo "$scratch"/foretouch-*)
    compiler=x86_64-w64-mingw32-gcc-posix library=$prefix/lib more=()
    program=$prefix/bin/table.exe run=("$@")  # beside the DLL
    ;;
esac
"$compiler" -I"$prefix/include" "$prefix/$example" -L"$library" -lforetouch -lm "${more[@]}" -o "$program"
gcc -I"$here/include" "$prefix/$example" -L"$here/lib" -lforetouch -lm -Wl,-rpath,"$(realpath "$here/lib")" -o "$scratch/here"
"${run[@]}" "$program" 2>"$scratch/said" | tr -d '\r' >"$scratch/there.txt" || { cat "$scratch/said" >&2; exit 1; }
"$scratch/here" >"$scratch/here.txt"
diff "$scratch/here.txt" "$scratch/there.txt"
[ -s "$scratch/there.txt" ]
say "$machine: the example tells what it tells here"

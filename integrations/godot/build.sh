#!/usr/bin/env bash
# Compiles the C files into an add-on's folder and puts the library beside them; nothing but a C compiler.
#   build.sh FOLDER_OF_LIBRARY FOLDER_OF_ADDON
set -euo pipefail
library=$(realpath "$1") root=$(cd "$(dirname "$0")/../.." && pwd)
native=$root/integrations/godot/native
mkdir -p "$2/linux-x64"
cp -f "$(realpath "$library/libforetouch.so")" "$2/linux-x64/libforetouch.so.0.1"
for godot in 3 4; do
  ${CC:-cc} -std=c99 -Wall -Wextra -Werror -O3 -fno-math-errno -flto -fPIC -shared -fvisibility=hidden \
    -I "$root" -I "$root/bindings/c/include" -o "$2/linux-x64/libforetouch_godot$godot.so" \
    "$native"/{place,scene,body,steps,solid,godot$godot}.c "$2/linux-x64/libforetouch.so.0.1" \
    -lm -Wl,--no-undefined -Wl,-rpath,'$ORIGIN'
done

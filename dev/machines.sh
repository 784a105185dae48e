# machines.sh: what it takes to build for other machines. Sourced after common.sh.

# What is needed to build for another machine and to run it, and where its packages lie.
prepare_cross() {  # prepare_cross MACHINE: sets emulator and suffix
  emulator=() suffix=''
  case "$1" in
    arm64)
      install_group arm64
      packages arm64-sysroot | xargs cmake/cross/sysroot.sh arm64 "$PWD/build/cross/sysroot-arm64"
      emulator=(qemu-aarch64 -L "$PWD/build/cross/sysroot-arm64")
      ;;
    wasm)
      install_group wasm
      packages cross-sources | xargs cmake/cross/sysroot.sh sources "$PWD/build/cross/sources"
      # Where Debian's emscripten finds acorn.
      export NODE_PATH=/usr/share/nodejs
      # With fetch(), which newer ones have, its programs look for themselves on the network.
      emulator=(node --no-experimental-fetch) suffix=.js
      ;;
    windows)
      install_group windows
      packages cross-sources | xargs cmake/cross/sysroot.sh sources "$PWD/build/cross/sources"
      # wine is told once what it may not ask about, and says no more than what fails.
      export WINEPREFIX=$PWD/build/cross/wine WINEDEBUG=-all WINEDLLOVERRIDES='mscoree,mshtml='
      emulator=(/usr/lib/wine/wine64) suffix=.exe
      ;;
    *) echo "run: cross: expected arm64, wasm or windows, found '$1'" >&2; exit 2 ;;
  esac
}

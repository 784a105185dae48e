#!/usr/bin/env bash
# dotnet.sh dotnet [--cost|--package|--generate]: the package for Unity and .NET.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh
package=integrations/dotnet

# The library as release files have it; those of other machines where ./run cross has built them.
make_package() {
  local others=() library
  date_of_sources
  configure portable
  cmake --build --preset portable --target foretouch_c >&2
  if [ -f build/cross/arm64/bindings/c/libforetouch.so ]; then
    library=$(readlink -f build/cross/arm64/bindings/c/libforetouch.so)
    others+=(--linux-arm64 "$library" --sysroot build/cross/sysroot-arm64)
  fi
  for library in build/cross/windows/bin/foretouch.dll build/cross/windows/bindings/c/foretouch.dll; do
    if [ -f "$library" ]; then others+=(--win-x64 "$library"); fi
  done
  python3 $package/packaging/make_package.py --output build/dotnet --version "$(version_of_sources)" \
    --linux-x64 "$(readlink -f build/portable/bindings/c/libforetouch.so)" "${others[@]}"
  $package/packaging/try_package.sh build/dotnet/com.foretouch.unity-*.tgz
}

shift  # the task
if [ "${1:-}" = --generate ]; then exec python3 $package/generator/generate.py csharp; fi
install_group dotnet
if [ "${1:-}" = --package ]; then
  make_package
  exit
fi
case "${1:---cost}" in --cost) ;; *) echo "run: dotnet: expected --cost, --package or --generate, found '$1'" >&2; exit 2 ;; esac
configure release -DFORETOUCH_BENCH=ON
cmake --build --preset release --target foretouch_c foretouch foretouch-import example >&2
exec $package/tests/dotnet_test.sh build/release/bindings/c build/release/bin/foretouch-import \
  build/release/share/foretouch/examples "$@"

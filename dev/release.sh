#!/usr/bin/env bash
# release.sh release [--check] [--again] [--machines] [--machines-again] [--web]: files that need no
# compiler and no package manager.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh
. dev/machines.sh
. dev/twice.sh

make_release() {  # make_release TREE: the files, from what is built there
  local tree=$1 version component
  version=$(version_of_sources)
  rm -rf "$tree"/installed "$tree"/foretouch-*.{tar.xz,whl,oci.tar}
  for component in runtime c c_dev python; do
    cmake --install "$tree" --prefix "$PWD/$tree/installed" --component "$component" >"$tree/install.log"
  done
  for component in archive wheel; do
    python3 cmake/release/release_files.py "$component" --installed "$tree/installed" --version "$version" --output "$tree"
  done
  if (command -v buildah >/dev/null || install_group image); then
    cmake/release/image.sh "$tree/foretouch-$version-linux-x86_64.tar.xz" "$version" \
      "$PWD/$tree/foretouch-$version-image.oci.tar"
  else
    echo "run: no buildah to be had: no image" >&2
  fi
}

# The C library for another machine, as `./run cross` tests it.
make_machine_files() {  # make_machine_files build/cross/MACHINE[-again]
  local tree=$1 machine component prefix=$PWD/$1/installed
  machine=$(basename "${tree%-again}")
  rm -rf "$prefix" "$tree"/*.{zip,deb}
  if [ "$machine" = arm64 ]; then prefix+=/usr; fi
  for component in c c_dev; do
    cmake --install "$tree" --prefix "$prefix" --component "$component" >"$tree/install.log"
  done
  python3 cmake/release/machine_files.py "$machine" --installed "$tree/installed" \
    --version "$(version_of_sources)" --output "$tree"
}

release_for_machines() {
  local machine emulator suffix
  for machine in arm64 windows; do
    prepare_cross "$machine"
    configure "$machine"
    cmake --build --preset "$machine" --target foretouch_c >&2
    make_machine_files "build/cross/$machine"
    tests/release/try_machine.sh "$machine" "build/cross/$machine" build/portable/installed "${emulator[@]}"
  done
}

shift  # the task
install_group release
date_of_sources
build portable >&2
make_release build/portable
tests/packaging/hardening.sh build/portable/installed/{bin/foretouch,bin/foretouch-verify,libexec/foretouch/foretouch-import}
for argument in "$@"; do
  case "$argument" in
    --check) tests/release/try_release.sh build/portable ;;
    --again) build_again_and_compare portable make_release 'foretouch-*.tar.xz' '*.whl' '*.oci.tar' ;;
    --machines) release_for_machines ;;
    --web)
      dev/page.sh npm >&2
      dev/page.sh page-only >&2
      ;;
    --machines-again)
      targets=(foretouch_c)
      build_again_and_compare cross/arm64 make_machine_files '*.deb'
      build_again_and_compare cross/windows make_machine_files '*.zip'
      unset targets
      ;;
    *) echo "run: release: expected --check, --again, --machines, --machines-again or --web, found '$argument'" >&2; exit 2 ;;
  esac
done

#!/usr/bin/env bash
# package.sh package [--check] [--again] | bill-of-materials: Debian packages, and what they stand on.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh
. dev/twice.sh

bill_of_materials() {  # bill_of_materials TREE
  local version built_with linked=("$1/bin/foretouch" "$1/bin/foretouch-import")
  mapfile -t built_with < <(packages build)
  version=$(version_of_sources)
  python3 cmake/packages/bill_of_materials.py --version "$version" --linked "${linked[@]}" \
    --built-with "${built_with[@]}" --lock viewer/package-lock.json
}

make_packages() {  # make_packages [TREE]
  local tree=${1:-build/packages}
  rm -f "$tree"/*.deb
  cmake -E env --unset=DESTDIR cpack --config "$tree/CPackConfig.cmake" -B "$tree" >"$tree/cpack.log" 2>&1 ||
    { cat "$tree/cpack.log" >&2; exit 1; }
  rm -rf "$tree/_CPack_Packages"
  ls "$tree"/*.deb
}

# A Debian of its own, with nothing in it, from wherever this machine gets its packages.
check_packages_in_chroot() {
  if [ "$(id -u)" -ne 0 ]; then
    echo "run: packages are not tried: a bare Debian can be made by root alone" >&2
    return
  fi
  install_group package-check
  local chroot mirror
  mirror=${FORETOUCH_MIRROR:-$(apt-get indextargets --format '$(SITE)' 'Codename: bookworm' | head -n 1)}
  chroot=$(mktemp -d)
  chmod 755 "$chroot"
  trap "tests/packaging/bare_debian.sh remove '$chroot'" EXIT
  if ! tests/packaging/bare_debian.sh make "$chroot" "$mirror" >"build/packages/debootstrap.log" 2>&1; then
    echo "run: packages are not tried: no bare Debian could be made (build/packages/debootstrap.log)" >&2
    return
  fi
  tests/packaging/try_packages.sh "$chroot" build/packages
}

task=$1
shift
case "$task" in
  package)
    install_group package
    date_of_sources
    build packages >&2
    make_packages
    tests/packaging/hardening.sh --packages build/packages
    bill_of_materials build/packages >build/packages/foretouch.cdx.json
    echo build/packages/foretouch.cdx.json
    for argument in "$@"; do
      case "$argument" in
        --check) check_packages_in_chroot ;;
        --again) build_again_and_compare packages make_packages '*.deb' ;;
        *) echo "run: package: expected --check or --again, found '$argument'" >&2; exit 2 ;;
      esac
    done
    ;;
  bill-of-materials)
    date_of_sources
    build release >&2
    bill_of_materials build/release
    ;;
esac

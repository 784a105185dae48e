#!/usr/bin/env bash
# Installs the Debian packages in a chroot with apt and uses them as somebody would who knows nothing
# of this source tree: runs the demonstration, builds and runs the C and C++ examples, runs Python.
#   try_packages.sh CHROOT FOLDER_OF_PACKAGES
set -euo pipefail
chroot=$1 packages=$2
here=$(dirname "$0")
work=/tmp/try-packages
rm -rf "$chroot$work"
mkdir -p "$chroot$work/packages"
cp "$packages"/*.deb "$chroot$work/packages/"
cp -r "$here/../consumer" "$chroot$work/"
if [ -d "$here/../../bindings/python/example" ]; then cp -r "$here/../../bindings/python/example" "$chroot$work/python-example"; fi
cp "$here/in_chroot.sh" "$chroot$work/"
# Nothing of this machine's environment: compilers and paths in it need not be there.
chroot "$chroot" /usr/bin/env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin /bin/bash "$work/in_chroot.sh" "$work"

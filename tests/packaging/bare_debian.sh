#!/usr/bin/env bash
# A Debian 12 with nothing in it but what every Debian has, which takes packages from where this
# machine takes them. For root.
#   bare_debian.sh make FOLDER MIRROR
#   bare_debian.sh remove FOLDER
set -euo pipefail
task=$1 folder=$2

make() {
  debootstrap --variant=minbase bookworm "$folder" "$1"
  # Sources, keys and proxies of this machine.
  rm -rf "$folder/etc/apt"
  cp -a /etc/apt "$folder/etc/apt"
  for keys in /usr/share/keyrings; do mkdir -p "$folder$keys" && cp -an "$keys/." "$folder$keys/"; done
  cp -L /etc/resolv.conf /etc/hosts "$folder/etc/"
  mount -t proc proc "$folder/proc"
  # A service that a package brings is not started here.
  printf '#!/bin/sh\nexit 101\n' >"$folder/usr/sbin/policy-rc.d"
  chmod +x "$folder/usr/sbin/policy-rc.d"
  chroot "$folder" apt-get update -qq
}

case "$task" in
  make) make "$3" ;;
  remove)
    if mountpoint -q "$folder/proc"; then umount "$folder/proc"; fi
    rm -rf --one-file-system "$folder"
    ;;
  *)
    echo "expected make or remove, found $task" >&2
    exit 2
    ;;
esac

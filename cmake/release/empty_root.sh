#!/usr/bin/env bash
# empty_root.sh ARCHIVE FOLDER: a root with nothing in it but the unpacked archive, in /opt/foretouch,
# and what every Linux has: the C library of this machine, with its loader, and an empty /tmp.
set -euo pipefail
archive=$1 root=$2
mkdir -p "$root"/{opt,tmp,proc,data,etc}
chmod 1777 "$root/tmp"
tar -xJf "$archive" -C "$root/opt" --no-same-owner
mv "$root"/opt/foretouch-* "$root/opt/foretouch"
for library in ld-linux-x86-64.so.2 libc.so.6 libm.so.6 libdl.so.2 libpthread.so.0 librt.so.1 libresolv.so.2; do
  place=$(ldconfig -p | sed -n "s|^\s*$library (libc6,x86-64.*=> ||p" | head -n 1)
  [ -n "$place" ] || { echo "empty_root: no $library; expected the C library of x86-64 Debian" >&2; exit 1; }
  install -D -m 755 "$(readlink -f "$place")" "$root/lib/x86_64-linux-gnu/$library"
done
mkdir -p "$root/lib64"
ln -s ../lib/x86_64-linux-gnu/ld-linux-x86-64.so.2 "$root/lib64/ld-linux-x86-64.so.2"
echo 'root:x:0:0:root:/data:/bin/false' >"$root/etc/passwd"

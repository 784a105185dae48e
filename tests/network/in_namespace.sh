#!/bin/sh
# Runs a program in a network namespace of its own, where multicast goes to lo and nothing leaves the
# machine: in_namespace.sh PROGRAM ARGUMENTS. Where namespaces are refused it says so in the words by
# which ctest knows a skipped test, and exits with 77.
set -u
options=-n
[ "$(id -u)" = 0 ] || options=-rn
if ! command -v unshare >/dev/null || ! command -v ip >/dev/null || ! unshare $options true 2>/dev/null; then
  case "$*" in
    *--gtest_list_tests*) exec "$@" ;;
  esac
  echo "[  SKIPPED ] unshare $options is refused here, or ip is missing"
  exit 77
fi
exec unshare $options sh -c '
  ip link set lo up && ip link set lo multicast on && ip route add 224.0.0.0/4 dev lo || exit 1
  FORETOUCH_PRIVATE_NETWORK=1 exec "$@"' in_namespace "$@"

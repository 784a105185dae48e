#!/bin/sh
# run.mjs where there is a node that can run it; else says why not and exits with 77, which ctest
# knows as skipped.
set -u
if ! node --eval 'process.exit(parseInt(process.versions.node) >= 18 ? 0 : 1)' 2>/dev/null; then
  echo "[  SKIPPED ] browser tests: there is no node 18 or later (Debian: apt install nodejs npm)"
  exit 77
fi
exec node "$(dirname "$0")/run.mjs" "$@"

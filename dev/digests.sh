#!/usr/bin/env bash
# digests.sh digests [ARGS...]: are outputs, byte for byte, those that were recorded?
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

shift  # the task
case " $* " in *" --program"*) ;; *) build release -DFORETOUCH_TESTS=ON >&2 ;; esac
exec python3 tests/digests/digests.py "$@"

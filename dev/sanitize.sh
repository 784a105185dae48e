#!/usr/bin/env bash
# sanitize.sh sanitize [asan|ubsan|tsan ...]: the tests under sanitizers.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

shift  # the task
[ $# -eq 0 ] && set -- asan tsan
prepare_browser_tests
for preset in "$@"; do
  build "$preset" -DFORETOUCH_TESTS=ON -DFORETOUCH_BENCH=ON
  ctest --preset "$preset" --parallel "$(nproc)"
done

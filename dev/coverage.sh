#!/usr/bin/env bash
# coverage.sh coverage [ARGS...]: what of the kernel, and of what reads a stranger's bytes, does no test
# come by? The arguments are those of tests/mutants/coverage.py.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

install_group coverage
configure coverage -DFORETOUCH_TESTS=ON -DFORETOUCH_BENCH=ON
shift  # the task's name
exec python3 tests/mutants/coverage.py "$@"

#!/usr/bin/env bash
# mutants.sh [ARGS...]: do the tests notice small wrong changes of the kernel? The arguments are those
# of tests/mutants/mutants.py.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

install_group build
shift  # the task's name
exec python3 tests/mutants/mutants.py "$@"

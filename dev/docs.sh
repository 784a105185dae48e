#!/usr/bin/env bash
# docs.sh docs|pictures|headers|python-types: what is read, and whether it holds.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh

reference_of_headers() {
  local headers
  headers=$(tr '\n' ' ' <build/release/public_headers.txt)
  mkdir -p build/docs
  { cat docs/Doxyfile; echo "INPUT = docs/api.md $headers"; } | doxygen -
  echo "build/docs/html/index.html"
}

check_python_types() {
  local MYPYPATH=build/release/lib/python3/dist-packages
  export MYPYPATH PYTHONPATH=$MYPYPATH PYTHONDONTWRITEBYTECODE=1
  /usr/bin/python3 -m mypy --strict --cache-dir build/release/mypy -p foretouch
  /usr/bin/python3 -m mypy --no-strict-optional --ignore-missing-imports --cache-dir build/release/mypy \
    bindings/python/example/*.py bindings/python/benchmark.py
  /usr/bin/python3 -m mypy.stubtest foretouch._foretouch --allowlist tests/bindings/python/stubtest_allowlist.txt
}

task=$1
shift
case "$task" in
  docs)
    install_group docs
    configure release
    reference_of_headers
    ;;
  pictures)
    install_group pictures
    build release -DFORETOUCH_BENCH=ON >&2
    exec docs/pictures/make_pictures.sh build/release/bin/foretouch
    ;;
  headers)
    configure release -DFORETOUCH_TESTS=ON -DFORETOUCH_BENCH=ON
    cmake --build --preset release --target headers_alone
    ;;
  python-types)
    install_group python-types
    build release -DFORETOUCH_BENCH=ON >&2
    check_python_types
    ;;
esac

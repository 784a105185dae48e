#!/usr/bin/env bash
# three.sh three [--cost]: the packages for three.js and Babylon.js.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh
. dev/machines.sh

shift  # the task
case "${1:-}" in
  '' | --cost) ;;
  *) echo "run: three: expected --cost, found '$1'" >&2; exit 2 ;;
esac
dev/page.sh npm >&2
if ! (install_browser); then echo "run: no Chromium to be had: the pages are not tested" >&2
elif ! (install_viewer_packages); then echo "run: npm's registry is out of reach: the pages are not tested" >&2; fi
export FORETOUCH_EXAMPLES=$PWD/build/release/share/foretouch/examples
exec integrations/three/tests/web_test.sh "$@"

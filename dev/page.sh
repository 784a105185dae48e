#!/usr/bin/env bash
# page.sh viewer|page|page-only|npm [ARGS...]: the pages, and the library for JavaScript.
set -euo pipefail
cd "$(dirname "$0")/.."
. dev/common.sh
. dev/machines.sh

# The built page is kept in the repository: only who changes viewer/ needs node.
build_viewer() {
  command -v npm >/dev/null || install_missing nodejs npm
  install_viewer_packages
  npm run --silent all
  if [ "${1:-}" = --page ]; then
    [ -n "${CHROMIUM:-}" ] || command -v chromium >/dev/null || install_missing chromium
    npm run --silent test:page
  fi
}

build_wasm_module() {
  command -v npm >/dev/null || install_missing nodejs npm
  (
    prepare_cross wasm
    cmake --preset npm
    cmake --build --preset npm --target foretouch_wasm
  ) >&2
}

# The page that one reaches into. Without a browser it is built all the same.
build_page() {
  build_wasm_module
  install_browser || echo "run: no Chromium to be had: the page is not tested" >&2
  mkdir -p build/page
  (install_viewer_packages && FORETOUCH_MODULE=$PWD/../build/cross/npm/bin/foretouch.wasm \
    FORETOUCH_PAGE=$PWD/../build/page/foretouch.html npm run --silent build:page)
  echo "page: build/page/foretouch.html, $(stat -c %s build/page/foretouch.html) bytes, $(gzip -9 -c build/cross/npm/bin/foretouch.wasm | wc -c) of the library, compressed"
}

# The module for JavaScript, its package, and its tests: beside the native program, where that is built.
make_npm_package() (  # make_npm_package [--hands [N]|--rays [N]]
  local version tarball scratch sources=$PWD
  build_wasm_module
  version=$(version_of_sources)
  mkdir -p build/npm
  cd bindings/wasm
  [ ! package-lock.json -nt node_modules/.package-lock.json ] || npm ci --no-audit --no-fund --silent
  npm run --silent build
  cp ../../build/cross/npm/bin/foretouch.wasm ../../LICENSE .
  [ "$(node -p 'require("./package.json").version')" = "$version" ]
  npm pack --silent --pack-destination ../../build/npm >/dev/null
  tarball=$PWD/../../build/npm/foretouch-$version.tgz
  export FORETOUCH_EXAMPLES=$PWD/../../build/release/share/foretouch/examples FORETOUCH_PROGRAM=$PWD/../../build/release/bin/foretouch
  [ -x "$FORETOUCH_PROGRAM" ] || echo "run: there is no $FORETOUCH_PROGRAM: the answers are not held against the native program's (./run build)" >&2
  node --test tests/module.test.mjs tests/structs.test.mjs tests/worlds.test.mjs tests/person.test.mjs tests/ask.test.mjs >&2
  scratch=$(mktemp -d)
  (cd "$scratch" && npm init -y >/dev/null && npm install --offline --no-audit --no-fund --silent "$tarball" &&
    node --no-experimental-fetch --input-type=module -e 'import { Foretouch } from "foretouch"; import { readFileSync } from "node:fs";
      const ft = await Foretouch.load(readFileSync("node_modules/foretouch/foretouch.wasm")); console.log(`npm: foretouch ${ft.version} from its package`)' &&
    node --no-experimental-fetch node_modules/foretouch/example/vr_hands.mjs | cmp - "$sources/tests/examples/vr_hands.txt")
  rm -rf "$scratch"
  case "${1:-}" in
    --hands) set -- hands --paths "${2:-10000}" ;;
    --rays) set -- rays --rays "${2:-2000}" ;;
    *) return 0 ;;
  esac
  (cd ../.. && configure release && cmake --build --preset release --target example) >&2
  node --no-experimental-fetch "tests/$1.mjs" "${@:2}"
)

task=$1
shift
case "$task" in
  viewer)
    build_viewer "$@"
    ;;
  npm)
    make_npm_package "$@"
    ;;
  page)
    build release >&2
    build_page
    tests/browser/run.sh --only page --shots build/page/shots || [ $? = 77 ]
    ;;
  page-only)
    build release >&2
    build_page
    ;;
esac

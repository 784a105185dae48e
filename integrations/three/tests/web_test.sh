#!/usr/bin/env bash
# The packages for three.js and Babylon.js: compiled, packed into build/npm, tested in node, used from an empty
# folder as their pages say, and their examples opened in Chromium with an emulated headset.
#   web_test.sh           all of it; without a screen, the network but for npm, or a headset
#   web_test.sh --node    only the tests in node, of what is installed already
#   web_test.sh --cost    what a step costs, measured
# Exit code 77, and why: foretouch for JavaScript is not built, or nothing is installed.
set -euo pipefail
cd "$(dirname "$0")/../../.."
version=$(sed -n 's/^project(foretouch VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
packages=$PWD/build/npm
foretouch=$packages/foretouch-$version.tgz

skip() { echo "left out: three.js and Babylon.js: $1"; exit 77; }
node --eval 'process.exit(parseInt(process.versions.node) >= 18 ? 0 : 1)' 2>/dev/null || skip "there is no node 18 or later (Debian: apt install nodejs npm)"
command -v npm >/dev/null || skip "there is no npm (Debian: apt install npm)"
[ -f "$foretouch" ] || skip "there is no $foretouch (./run npm makes it)"

# Compiled against the package, as users' own code is.
prepare() (  # prepare HOST
  cd "integrations/$1"
  if [ package-lock.json -nt node_modules/.package-lock.json ]; then
    [ "${mode:-}" != --node ] || exit 1
    npm ci --no-audit --no-fund --silent || exit 1
  fi
  rm -rf node_modules/foretouch
  mkdir node_modules/foretouch
  tar -xzf "$foretouch" -C node_modules/foretouch --strip-components=1
  cp ../../LICENSE .
  [ "$(node -p 'require("./package.json").version')" = "$version" ]
  npm run --silent build
)

in_node() {  # in_node HOST
  echo "== $1, in node"
  (cd "integrations/$1" && node --test tests/*.test.mjs)
}

# The page's lines, as they stand, in an empty folder with the three packages beside it.
as_the_page_says() (  # as_the_page_says HOST FOLDER
  local page=$PWD/integrations/$1/README.md
  (cd "integrations/$1" && npm pack --silent --pack-destination "$packages" >/dev/null)
  cd "$2"
  cp "$foretouch" "$packages/foretouch-$1-$version.tgz" .
  awk '/^```sh/ { on = 1; next } /^```/ { on = 0 } on' "$page" >install.sh
  awk '/^```js/ { on = 1; next } /^```/ { on = 0 } on' "$page" >try.mjs
  bash -e install.sh >&2
  node try.mjs | tee said.txt
  diff <(sed -n 's/.*\/\/ prints: //p' try.mjs) said.txt
)

mode=${1:-} failed=0
for host in three babylon; do
  prepare "$host" || skip "npm's packages for $host are not installed, and cannot be had (./run three installs them)"
done
case "$mode" in
  --node) in_node three; in_node babylon; exit ;;
  --cost) exec node integrations/three/tests/cost.mjs ;;
esac
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
mkdir -p build/three
for host in three babylon; do
  in_node "$host"
  echo "== $host, as its page says"
  mkdir "$scratch/$host"
  as_the_page_says "$host" "$scratch/$host"
  echo "== $host, its example in Chromium"
  node integrations/three/tests/pages.mjs "$host" "$scratch/$host" build/three || { [ $? = 77 ] || failed=1; }
done
exit $failed

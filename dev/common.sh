# common.sh: what ./run and the scripts beside this one share. Sourced in the project's root.

# The packages of a group, from packages.txt.
packages() {  # packages GROUP
  awk -v group="$1" '$1 == group { for (i = 2; i <= NF; ++i) print $i }' dev/packages.txt
}

install_missing() {
  local missing=() package
  for package in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -eq 0 ] && return
  echo "run: installing ${missing[*]}" >&2
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -qq --no-install-recommends "${missing[@]}" >&2
}

install_group() {  # install_group GROUP
  local needed
  mapfile -t needed < <(packages "$1")
  install_missing "${needed[@]}"
}

configure() {  # configure PRESET [CMAKE OPTIONS...]
  install_group build
  (install_group optional) || echo "run: not to be had: $(packages optional | xargs); what needs it is left out" >&2
  case " $* " in *" -DFORETOUCH_PEERS=ON "*) install_group peers ;; esac
  case " $* " in *" -DFORETOUCH_OMPL=ON "*) install_group plans ;; esac
  local log
  log=$(cmake --preset "$@" 2>&1) || { echo "$log" >&2; exit 1; }
}

build() {  # build PRESET [CMAKE OPTIONS...]
  configure "$@"
  cmake --build --preset "$1"
}

build_tests() {  # build_tests [CMAKE OPTIONS...]
  build release -DFORETOUCH_TESTS=ON -DFORETOUCH_BENCH=ON "$@"
}

readonly measurements=docs/measurements

# Node and a browser may be there without being Debian's packages.
install_browser() {
  local package missing=()
  while read -r package; do
    command -v "${package/nodejs/node}" >/dev/null || missing+=("$package")
  done < <(packages browser)
  [ ${#missing[@]} -eq 0 ] || install_missing "${missing[@]}"
}

install_viewer_packages() {
  cd viewer
  npm ci --no-audit --no-fund --silent
}

install_gltf_packages() { install_npm_packages tests/assets/gltf_oracle; }

install_npm_packages() (  # install_npm_packages FOLDER
  cd "$1"
  [ ! package-lock.json -nt node_modules/.package-lock.json ] || npm ci --ignore-scripts --no-audit --no-fund --silent
)

prepare_browser_tests() {
  local installed=viewer/node_modules/.package-lock.json
  if ! (install_browser); then
    echo "run: no node or no Chromium to be had: the tests of the pages in a browser will be skipped" >&2
  elif [ ! viewer/package-lock.json -ot "$installed" ] && ! (install_viewer_packages); then
    echo "run: npm's registry is out of reach: the tests of the pages in a browser will be skipped" >&2
  fi
  if command -v npm >/dev/null && ! install_gltf_packages; then
    echo "run: npm's registry is out of reach: the test of glTF by other programs will be skipped" >&2
  fi
  if command -v npm >/dev/null && ! install_npm_packages tests/network/vmc; then
    echo "run: npm's registry is out of reach: the test of VMC by node-osc will be skipped" >&2
  fi
}

# The date of all that is packaged: of the last commit, so that who builds the same gets the same bytes.
date_of_sources() {
  if [ -z "${SOURCE_DATE_EPOCH:-}" ]; then
    SOURCE_DATE_EPOCH=$(git log -1 --format=%ct 2>/dev/null || stat -c %Y CHANGELOG.md)
  fi
  export SOURCE_DATE_EPOCH
}

version_of_sources() { sed -n 's/^project(foretouch VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt; }

# twice.sh: two builds compared. Sourced after common.sh.

# From nothing, in another folder and without a cache.
build_again_and_compare() {  # build_again_and_compare PRESET MAKE PATTERN...: MAKE TREE makes the files
  local tree=build/$1-again make=$2 pattern file
  rm -rf "$tree"
  cmake --preset "${1##*/}" -B "$tree" >/dev/null
  CCACHE_DISABLE=1 cmake --build "$tree" --target "${targets[@]-all}" >&2
  "$make" "$tree" >/dev/null
  for pattern in "${@:3}"; do
    for file in "build/$1"/$pattern; do
      cmp "$file" "$tree/$(basename "$file")" || { echo "run: two builds of $(basename "$file") differ" >&2; exit 1; }
      echo "the same twice: $(basename "$file")"
    done
  done
}

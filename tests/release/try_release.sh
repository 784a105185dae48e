#!/usr/bin/env bash
# Uses the files of `./run release` as somebody would who has neither source nor compiler, each in an
# empty place: the archive in a root with nothing else in it, the image by buildah, the wheel in a
# virtual environment. Needs root for the first two; says what it leaves out.
#   try_release.sh FOLDER
set -euo pipefail
folder=$(realpath "$1") here=$(dirname "$(realpath "$0")")
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
say() { echo "try_release: $*"; }
of() { find "$folder" -maxdepth 1 -name "$1" | sort | tail -n 1; }
archive=$(of 'foretouch-*-linux-x86_64.tar.xz') wheel=$(of 'foretouch-*.whl') image=$(of 'foretouch-*-image.oci.tar')
examples=/opt/foretouch/share/foretouch/examples
bare=(/usr/bin/env -i HOME=/data PATH=/nowhere)

# A body that meets furniture, its report, and a scene that the importer read in its cage.
is_answer() {  # is_answer FOLDER
  grep -q '"format":"foretouch-results"' "$1/contacts.jsonl"
  grep -q '"summary"' "$1/contacts.jsonl"
  grep -q '</html>' "$1/report.html"
}
# But for what differs from run to run: how long each step took.
same_answers() { diff -q <(untimed "$1") <(untimed "$2"); }
untimed() { sed 's/"latency_us":\([0-9.e+-]*\|{[^}]*}\)//' "$1"; }
replay_of() { echo replay --scene "$1/room.obj" --avatar "$1/dancer.avatar.json" --motion "$1/dancer.bvh" \
  --output "$2/contacts.jsonl" --report "$2/report.html"; }
in_root() {  # the program of the archive, in its root
  unshare --mount --pid --fork bash -c 'mount -t proc proc "$1/proc" && exec chroot "$@"' - "$scratch/root" \
    /opt/foretouch/bin/foretouch "$@"
}
seconds_since() { awk -v a="$1" -v b="$(date +%s.%N)" 'BEGIN { printf "%.1f", b - a }'; }

if [ "$(id -u)" -eq 0 ]; then
  say "the archive, in a root with nothing else in it"
  began=$(date +%s.%N)
  "$here/../../cmake/release/empty_root.sh" "$archive" "$scratch/root"
  mkdir "$scratch/root/dev"
  mknod -m 666 "$scratch/root/dev/null" c 1 3
  unpacked=$(date +%s.%N)
  # shellcheck disable=SC2046
  in_root $(replay_of $examples /data) >"$scratch/replay.txt"
  is_answer "$scratch/root/data"
  say "from unpacked to the report in $(seconds_since "$unpacked") s, unpacking in $(awk -v a="$began" -v b="$unpacked" 'BEGIN { printf "%.1f", b - a }') s"
  cp "$scratch/root/data/contacts.jsonl" "$scratch/contacts.jsonl"
  say "README's first line: the demonstration"
  in_root demo --output /data/demo.jsonl >"$scratch/demo.txt"
  grep -q 'The dancer touches the room' "$scratch/demo.txt"
  grep -q '</html>' "$scratch/root/data/demo.html"
  say "the archive once more over itself, which changes nothing"
  (cd "$scratch/root/opt" && find . -type f -exec sha256sum {} + | sort >"$scratch/before")
  mv "$scratch/root/opt/foretouch" "$scratch/root/opt/$(basename "$archive" .tar.xz)"
  tar -xJf "$archive" -C "$scratch/root/opt" --no-same-owner
  mv "$scratch/root/opt/$(basename "$archive" .tar.xz)" "$scratch/root/opt/foretouch"
  (cd "$scratch/root/opt" && find . -type f -exec sha256sum {} + | sort | cmp - "$scratch/before")
else
  say "not root: the archive and the image are not tried"
fi

if [ "$(id -u)" -eq 0 ] && [ -n "$image" ] && command -v buildah >/dev/null; then
  say "the image"
  tools=(--root "$scratch/storage" --runroot "$scratch/run" --storage-driver vfs)
  container=$(buildah "${tools[@]}" from "oci-archive:$image")
  place=$(buildah "${tools[@]}" mount "$container")
  # shellcheck disable=SC2046
  buildah "${tools[@]}" run --isolation chroot "$container" -- /opt/foretouch/bin/foretouch $(replay_of $examples /data) \
    >"$scratch/image.txt"
  is_answer "$place/data"
  same_answers "$place/data/contacts.jsonl" "$scratch/contacts.jsonl"
  buildah "${tools[@]}" rm "$container" >/dev/null
fi

say "the wheel, in an environment of its own"
/usr/bin/python3 -m venv --system-site-packages "$scratch/venv"
"$scratch/venv/bin/pip" --quiet --disable-pip-version-check install --no-index --no-deps "$wheel"
mkdir "$scratch/wheel"
began=$(date +%s.%N)
# shellcheck disable=SC2046
(cd "$scratch/wheel" && "${bare[@]}" "$scratch/venv/bin/python3" -c 'import foretouch; print(foretouch.example_folder())' >place)
"${bare[@]}" "$scratch/venv/bin/foretouch" $(replay_of "$(cat "$scratch/wheel/place")" "$scratch/wheel") >"$scratch/wheel.txt"
is_answer "$scratch/wheel"
say "from installed to the report in $(seconds_since "$began") s"
if [ -f "$scratch/contacts.jsonl" ]; then same_answers "$scratch/wheel/contacts.jsonl" "$scratch/contacts.jsonl"; fi
(cd "$scratch/wheel" && "${bare[@]}" "$scratch/venv/bin/python3" "$here/../../bindings/python/example/hand_through_railing.py" >railing)
say "passed"

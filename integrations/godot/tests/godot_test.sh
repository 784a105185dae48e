#!/usr/bin/env bash
# The add-on for Godot, run by Debian's godot3-server, without a screen: what nodes report and what they say of bad
# habits, all answers beside those of C, the demo, and the entry for Godot 4 in a host of our own.
#   godot_test.sh FOLDER_OF_LIBRARY IMPORTER FOLDER_OF_EXAMPLES                all tests
#   godot_test.sh FOLDER_OF_LIBRARY IMPORTER FOLDER_OF_EXAMPLES --cost         what the border costs, measured
#   godot_test.sh FOLDER_OF_LIBRARY IMPORTER FOLDER_OF_EXAMPLES --hands [N]    N hands led at a thin board (10,000)
#   godot_test.sh FOLDER_OF_LIBRARY IMPORTER FOLDER_OF_EXAMPLES --film         the demo, a line per frame
set -euo pipefail
library=$(realpath "$1") importer=$(realpath "$2") examples=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
package=$(dirname "$here")
for program in godot3-server cc; do
  command -v "$program" >/dev/null || { echo "left out: Godot, which needs $program"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export HOME=$folder LC_ALL=C.UTF-8 LD_LIBRARY_PATH=$library FORETOUCH_IMPORTER=$importer
export FORETOUCH_EXAMPLES=$examples FORETOUCH_OUT=$folder

cc_here() {  # cc_here OUTPUT ARGUMENTS...
  cc -std=c99 -Wall -Wextra -Werror -O2 -I "$package/../.." -I "$package/../../bindings/c/include" -o "$folder/$1" "${@:2}" -L "$library" -lforetouch -lm
}
# What Godot prints of itself at every start is of the machine: no locale, no sound.
godot() {  # godot PROJECT ARGUMENTS...
  local result=0
  godot3-server --path "$1" "${@:2}" >"$folder/out.txt" 2>&1 || result=$?
  grep -v -e '^Godot Engine' -e 'locale' -e 'translation.cpp' -e '^ *$' "$folder/out.txt" >"$folder/said.txt" || true
  return $result
}
must() {  # must PROJECT SCRIPT: without a failed check, nor an error of a script
  if ! godot "$1" -s "$2" || grep -q -e '^SCRIPT ERROR' -e '^FAILED' "$folder/said.txt"; then
    cat "$folder/said.txt"
    exit 1
  fi
}

project=$folder/project
mkdir -p "$project/addons"
cp -r "$package/addons/foretouch" "$project/addons/"
cp "$here"/*.gd "$project/"
printf 'config_version=4\n' >"$project/project.godot"
"$package/build.sh" "$library" "$project/addons/foretouch"

case "${4:-}" in
  --cost)
    cc_here cost "$here/cost.c"
    must "$project" cost.gd
    "$folder/cost" "$examples" "$folder/poses.bin" "$folder/said.txt"
    exit
    ;;
  --film)
    cp -r "$package/demo" "$folder/demo"
    cp -r "$project/addons" "$here/film.gd" "$folder/demo/"
    godot "$folder/demo" --fixed-fps 60 -s film.gd
    sed -n 's/^film: //p' "$folder/said.txt"
    exit
    ;;
  --hands)
    export FORETOUCH_HANDS=${5:-10000}
    for engine in Bullet GodotPhysics; do
      printf 'config_version=4\n[physics]\n3d/physics_engine="%s"\n' "$engine" >"$project/project.godot"
      must "$project" hands.gd
      grep ' hands, ' "$folder/said.txt"
    done
    exit
    ;;
esac

echo "== nodes"
must "$project" nodes.gd
sed -n 's/^expect: //p' "$folder/said.txt" >"$folder/expected.txt"
[ "$(wc -l <"$folder/expected.txt")" -gt 15 ] || { echo "expected more than 15 bad habits"; exit 1; }
while read -r words; do
  grep -e '^ERROR' -e '^WARNING' "$folder/said.txt" | grep -qF -- "$words" || { echo "expected that Godot prints: $words"; exit 1; }
done <"$folder/expected.txt"
echo "$(wc -l <"$folder/expected.txt") bad habits, each told; $(tail -n 1 <(grep ' checks, ' "$folder/said.txt"))"

echo "== answers, beside those of C"
cc_here answers "$here/answers.c"
must "$project" answers.gd
"$folder/answers" clip "$examples" room dancer steps >"$folder/c_steps.bin"
"$folder/answers" clip "$examples" desk hand ticks >"$folder/c_ticks.bin"
cmp "$folder/steps.bin" "$folder/c_steps.bin"
cmp "$folder/ticks.bin" "$folder/c_ticks.bin"
echo "$(wc -c <"$folder/steps.bin") and $(wc -c <"$folder/ticks.bin") bytes of the bundled clips: the same"
"$folder/answers" own "$folder/own.bin"

echo "== colliders of an avatar"
if [ -x "$(dirname "$importer")/foretouch" ]; then
  "$(dirname "$importer")/foretouch" avatar colliders "$examples/dancer.avatar.json" --godot 3 -o "$project/dancer.tscn"
  must "$project" colliders.gd
  grep ' checks, ' "$folder/said.txt"
else
  echo "left out: they need the program"
fi

echo "== the demo"
cp -r "$package/demo" "$folder/demo"
cp -r "$project/addons" "$folder/demo/"
godot "$folder/demo" --fixed-fps 60
for words in 'touches Bar3' 'leaves Bar3' 'touches Button' 'the button is pressed' 'touches Door' 'the door is open by [3-9][0-9] degrees'; do
  grep -q "$words" "$folder/said.txt" || { echo "expected '$words', found:"; cat "$folder/said.txt"; exit 1; }
done
grep 'the door is open' "$folder/said.txt"

echo "== the script of the README"
awk '/^```gdscript/ { on = 1; next } /^```/ { on = 0 } on' "$package/README.md" >"$project/try.gd"
must "$project" try.gd
grep -qxF "$(sed -n 's/.*# prints: //p' "$project/try.gd")" "$folder/said.txt" ||
  { echo "expected what the README says, found:"; cat "$folder/said.txt"; exit 1; }

echo "== the entry for Godot 4, in a host of our own"
cc_here godot4_host "$here/godot4_host.c" -ldl
"$folder/godot4_host" "$project/addons/foretouch/linux-x64/libforetouch_godot4.so"

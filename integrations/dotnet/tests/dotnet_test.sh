#!/usr/bin/env bash
# The package for .NET and Unity, compiled and run by Mono: is what is generated current, do structs lie as
# the C compiler puts them, are all answers those of C, what do components say, and does a step make garbage?
#   dotnet_test.sh FOLDER_OF_LIBRARY IMPORTER FOLDER_OF_EXAMPLES        all tests
#   dotnet_test.sh FOLDER_OF_LIBRARY IMPORTER FOLDER_OF_EXAMPLES --cost what the border costs, measured
#   dotnet_test.sh FOLDER_OF_LIBRARY IMPORTER FOLDER_OF_EXAMPLES --film the sample, a line per fixed update
set -euo pipefail
library=$(realpath "$1") importer=$(realpath "$2") examples=$(realpath "$3")
here=$(cd "$(dirname "$0")" && pwd)
package=$(dirname "$here") headers=$here/../../../bindings/c/include
for program in mcs mono cc python3; do
  command -v "$program" >/dev/null || { echo "left out: C# and Unity, which need $program"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export LD_LIBRARY_PATH=$library:$folder FORETOUCH_IMPORTER=$importer

compile() {  # compile OUTPUT ARGUMENTS...
  mcs -nologo -unsafe -langversion:latest -warnaserror -r:System.Core -out:"$folder/$1" "${@:2}"
}
cc_here() {  # cc_here OUTPUT ARGUMENTS...
  cc -std=c99 -Wall -Wextra -Werror -O2 -I "$headers" -I "$folder" -o "$folder/$1" "${@:2}" -L "$library" -lforetouch
}
generate() { python3 "$package/generator/generate.py" "$1"; }

compile Foretouch.dll -target:library "$package"/Runtime/{,Native/,Engine/}*.cs

if [ "${4:-}" = --cost ]; then
  cc_here libcost.so -shared -fPIC "$here/cost.c"
  compile cost.exe -r:"$folder/Foretouch.dll" "$here/Cost.cs"
  mono "$folder/cost.exe" "$examples"
  exit
fi

player() {  # the components, and what plays Unity
  compile Unity.dll -target:library -define:UNITY_5_3_OR_NEWER "$package"/Runtime/{,Native/,Engine/,Unity/}*.cs "$here"/Fake*.cs
}
if [ "${4:-}" = --film ]; then
  player
  compile film.exe -r:"$folder/Unity.dll" "$here/Film.cs" "$package"/Samples~/*/*.cs
  mono "$folder/film.exe" | sed -n 's/^film: //p'
  exit
fi

echo "== what is generated"
generate check
python3 "$here/generator_test.py" 2>&1 | tail -n 1

echo "== how structs lie in memory, and what functions take"
generate layout >"$folder/layout.c"
cc -std=c11 -I "$headers" -o "$folder/layout" "$folder/layout.c"
compile layouts.exe -r:"$folder/Foretouch.dll" "$here/Layouts.cs"
"$folder/layout" | sort >"$folder/c.txt"
mono "$folder/layouts.exe" structs | sort >"$folder/cs.txt"
diff "$folder/c.txt" "$folder/cs.txt" || { echo "< the C compiler, > C#"; exit 1; }
fields=$(grep -c ' x' "$folder/c.txt") structs=$(grep -c ' size [0-9]*$' "$folder/c.txt")
[ "$structs" -gt 50 ] || { echo "expected more than 50 structs, found $structs"; exit 1; }
mono "$folder/layouts.exe" functions | sort >"$folder/functions.txt"
diff <(grep -oh '^FT_API [^(]*(' "$headers"/foretouch/*.h | grep -o 'ft_[a-z0-9_]*' | grep -v '^ft_status$' | sort -u) \
  <(grep -o 'ft_[a-z0-9_]*' "$folder/functions.txt" | sort -u) || { echo "< in the headers, > C#"; exit 1; }
if python3 -c 'import pycparser' 2>/dev/null; then
  diff <(python3 "$here/prototypes.py" "$headers/foretouch" | sort) "$folder/functions.txt" || { echo "< C, > C#"; exit 1; }
else
  echo "left out: what functions take, which needs python3-pycparser"
fi
echo "$structs structs with $fields fields, $(wc -l <"$folder/functions.txt") functions"

echo "== answers, beside those of C"
generate dump >"$folder/dump.h"
cc_here answers "$here/answers.c"
compile answers.exe -r:"$folder/Foretouch.dll" "$here"/{Answers,Dump}.cs
"$folder/answers" "$examples" >"$folder/c.txt"
mono "$folder/answers.exe" "$examples" >"$folder/cs.txt"
cmp "$folder/c.txt" "$folder/cs.txt"
echo "$(wc -l <"$folder/c.txt") answers, $(wc -w <"$folder/c.txt") numbers: the same bits"

echo "== errors"
compile errors.exe -r:"$folder/Foretouch.dll" "$here"/{Errors,Check}.cs
mono "$folder/errors.exe"
LD_LIBRARY_PATH='' mono "$folder/errors.exe" absent

echo "== components, in a player of our own"
player
compile components.exe -r:"$folder/Unity.dll" "$here"/{Components,Check}.cs "$package"/Samples~/*/*.cs
files=()
if [ -x "$(dirname "$importer")/foretouch" ]; then
  "$(dirname "$importer")/foretouch" avatar colliders "$examples/dancer.avatar.json" -o "$folder/dancer.json"
  files=("$examples/dancer.avatar.json" "$folder/dancer.json")
else
  echo "left out: colliders, which need the program"
fi
mono "$folder/components.exe" "${files[@]}"
compile garbage.exe -r:"$folder/Unity.dll" "$here"/{Garbage,Check}.cs
mono "$folder/garbage.exe"

echo "== the program of the README"
awk '/^```csharp/ && !done { on = 1; next } /^```/ && on { done = 1; on = 0 } on' "$package/README.md" >"$folder/Program.cs"
compile program.exe -r:"$folder/Foretouch.dll" "$folder/Program.cs"
mono "$folder/program.exe" >"$folder/program.txt"
grep -qxF "$(sed -n 's/.*\/\/ prints: //p' "$folder/Program.cs")" "$folder/program.txt" ||
  { echo "expected what the README says, found: $(cat "$folder/program.txt")"; exit 1; }

#!/usr/bin/env bash
# The structs in C# lie where those of C do: each has every line that layout_test.cpp has of it.
#   cs_layout_test.sh SOURCE_FOLDER
set -euo pipefail
source=$1
if ! command -v mcs >/dev/null || ! command -v mono >/dev/null; then
  echo "left out: the layouts of Foretouch.cs, which need mcs and mono"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mcs -unsafe -out:"$folder/layouts.exe" "$source"/bindings/c/example/*.cs "$source/tests/bindings/Layouts.cs"
mono "$folder/layouts.exe" | sort >"$folder/cs.txt"
structs=$(grep -o '^static_assert(sizeof([a-z_]*)' "$folder/cs.txt" | grep -o 'ft_[a-z_]*')
[ "$(echo "$structs" | wc -l)" -gt 15 ] || { echo "expected more than 15 structs in C#"; exit 1; }
for name in $structs; do
  grep -E "^(AT\($name,|static_assert\(sizeof\($name\))" "$source/tests/bindings/layout_test.cpp"
done | grep -v ', size, 0);' | sort >"$folder/c.txt"
diff "$folder/c.txt" "$folder/cs.txt" || { echo "< layout_test.cpp, > C#"; exit 1; }

#!/usr/bin/env bash
# Uses the package as a newcomer would who has Mono alone: unpacks it, compiles its sources, and runs the
# program of its README with the library in it and no other.
#   try_package.sh TARBALL
set -euo pipefail
tarball=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
tar -xzf "$tarball"
cd package
fail() { echo "try_package: $1" >&2; exit 1; }

# Unity leaves out what has no .meta, and confuses two of one number.
while read -r file; do
  [ -f "$file.meta" ] || fail "$file has no .meta"
done < <(find . -mindepth 1 \( -path './Samples~*' -o -name '*.meta' \) -prune -o -print)
[ -z "$(find . -name '*.meta' -exec grep -h ^guid {} + | sort | uniq -d)" ] || fail "two files have one guid"
python3 -c 'import json; json.load(open("package.json")); json.load(open("Runtime/Foretouch.asmdef"))'
python3 -c 'import xml.dom.minidom; xml.dom.minidom.parse("Foretouch.csproj")'

if ldd Plugins/linux-x64/*.so | grep 'not found'; then fail "a library is missing"; fi
if ldd Plugins/linux-x64/libforetouch.so | grep -v "$folder" | grep -vE 'linux-vdso|ld-linux|/lib(c|m|stdc\+\+|gcc_s)\.so'; then
  fail "a library is not the package's own"
fi
awk '/^```csharp/ && !done { on = 1; next } /^```/ && on { done = 1; on = 0 } on' README.md >Program.cs
mcs -nologo -unsafe -langversion:latest -out:program.exe Program.cs Runtime/*.cs Runtime/Native/*.cs Runtime/Engine/*.cs
env -i PATH="$PATH" HOME="$HOME" LD_LIBRARY_PATH="$PWD/Plugins/linux-x64" mono program.exe | tee printed.txt
grep -qxF "$(sed -n 's/.*\/\/ prints: //p' Program.cs)" printed.txt || fail "expected what the README says"

#!/usr/bin/env bash
# The library shows the functions that its headers declare, all of them and nothing else.
#   exports_test.sh NM LIBRARY FOLDER_OF_HEADERS SONAME
set -euo pipefail
nm=$1 library=$2 headers=$3 soname=$4
declared=$(grep -oh '^FT_API [^(]*(' "$headers"/*.h | grep -o 'ft_[a-z0-9_]*(' | tr -d '(' | sort)
# Type A is the name of the version that the symbols carry.
shown=$("$nm" -D --defined-only "$library" | awk '$2 != "A" {sub(/@.*/, "", $3); print $3}' | sort)
[ "$(echo "$declared" | wc -l)" -gt 30 ] || { echo "expected more than 30 declarations in $headers"; exit 1; }
diff <(echo "$declared") <(echo "$shown") || { echo "< declared, > shown by $library"; exit 1; }
case "$soname" in
  libforetouch.so.[0-9]*) ;;
  *) echo "expected a soname with a version, found $soname"; exit 1 ;;
esac

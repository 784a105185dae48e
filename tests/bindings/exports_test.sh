#!/usr/bin/env bash
# The library shows the functions that its header declares, all of them and nothing else.
#   exports_test.sh NM LIBRARY HEADER SONAME
set -euo pipefail
nm=$1 library=$2 header=$3 soname=$4
declared=$(grep -o '^FT_API [^(]*(' "$header" | grep -o 'ft_[a-z0-9_]*(' | tr -d '(' | sort)
# Type A is the name of the version that the symbols carry.
shown=$("$nm" -D --defined-only "$library" | awk '$2 != "A" {sub(/@.*/, "", $3); print $3}' | sort)
[ "$(echo "$declared" | wc -l)" -gt 30 ] || { echo "expected more than 30 declarations in $header"; exit 1; }
diff <(echo "$declared") <(echo "$shown") || { echo "< declared, > shown by $library"; exit 1; }
case "$soname" in
  libforetouch.so.[0-9]*) ;;
  *) echo "expected a soname with a version, found $soname"; exit 1 ;;
esac

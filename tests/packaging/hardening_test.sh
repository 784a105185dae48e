#!/usr/bin/env bash
# hardening_test.sh CMAKE BUILD_FOLDER PROGRAMS: hardening.sh passes the hardened sample, and names what
# the other lacks.
set -euo pipefail
cmake=$1 build=$2 programs=$3
here=$(dirname "$0")
"$cmake" --build "$build" --target hardened_sample plain_sample >/dev/null
"$here/hardening.sh" "$programs/hardened_sample"
if found=$("$here/hardening.sh" "$programs/hardened_sample" "$programs/plain_sample"); then
  echo "a program without hardening passed" >&2
  exit 1
fi
for missing in PIE RELRO NOW stack-protector FORTIFY; do
  grep -q "^not hardened: plain_sample .*\b$missing\b" <<<"$found" || { echo "$missing was not missed: $found" >&2; exit 1; }
done

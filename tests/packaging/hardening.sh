#!/usr/bin/env bash
# Is every program and shared library hardened? For each: an address of its own on every start (PIE; a
# library has one), relocations that become read-only at the start (RELRO and NOW), a stack that is
# no code, and, in what is asked for it, the stack's protector and checked calls of the C library.
#   hardening.sh FILE...            these
#   hardening.sh --packages FOLDER  every ELF file in the Debian packages there
# Prints one line for each; exit code 1 where something lacks.
set -euo pipefail

of_packages() {
  local unpacked package
  unpacked=$(mktemp -d)
  trap "rm -rf '$unpacked'" EXIT
  for package in "$1"/*.deb; do dpkg-deb -x "$package" "$unpacked"; done
  local file elves=()
  while IFS= read -r -d '' file; do
    # Static libraries are for others to link.
    if [ "$(head -c 4 "$file" | tr -d '\0')" = $'\x7fELF' ]; then elves+=("$file"); fi
  done < <(find "$unpacked" -type f -print0 | sort -z)
  check "${elves[@]}"
}

lacks=0
check() {
  local file header segments dynamic symbols missing
  for file in "$@"; do
    header=$(readelf -hW "$file") segments=$(readelf -lW "$file") dynamic=$(readelf -dW "$file")
    symbols=$(readelf --dyn-syms -W "$file")
    missing=()
    grep -q 'Type: *DYN' <<<"$header" || missing+=(PIE)
    grep -q GNU_RELRO <<<"$segments" || missing+=(RELRO)
    grep -qE 'BIND_NOW|Flags:.*NOW' <<<"$dynamic" || missing+=(NOW)
    if grep GNU_STACK <<<"$segments" | grep -q E; then missing+=(stack-without-code); fi
    grep -q __stack_chk_fail <<<"$symbols" || missing+=(stack-protector)
    grep -qE '__[a-z]+_chk\b' <<<"$symbols" || missing+=(FORTIFY)
    if [ ${#missing[@]} -eq 0 ]; then
      echo "hardened: $(basename "$file")"
    else
      echo "not hardened: $(basename "$file") lacks ${missing[*]}"
      lacks=1
    fi
  done
}

if [ $# -eq 0 ]; then sed -n '2,/^set /s/^# \{0,1\}//p' "$0" >&2; exit 2; fi
if [ "$1" = --packages ]; then of_packages "$2"; else check "$@"; fi
exit "$lacks"

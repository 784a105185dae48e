#!/usr/bin/env bash
# sysroot.sh ARCHITECTURE FOLDER PACKAGE...: unpacks Debian's packages of another architecture, and all that they
#   need, into FOLDER.
# sysroot.sh sources FOLDER PACKAGE...: the packages alone, for machines that are not Debian's: those of headers are
#   the same for all; of a name that begins with "source:", the sources as their authors release them.
# This machine's own packages stay as they are: apt keeps its lists apart, in FOLDER.apt, and nothing is installed.
# Does nothing where FOLDER has them already.
set -euo pipefail
architecture=$1 folder=$2
shift 2

if [ "$(cat "$folder/packages" 2>/dev/null)" = "$*" ]; then exit 0; fi
rm -rf "$folder" "$folder.apt"
mkdir -p "$folder" "$folder.apt/state/lists/partial" "$folder.apt/cache/archives/partial" "$folder.apt/files"
: > "$folder.apt/status"
{
  if [ "$architecture" = sources ]; then
    # Debian's own list, for sources as well.
    sed 's/^Types: deb$/Types: deb deb-src/' /etc/apt/sources.list.d/debian.sources > "$folder.apt/debian.sources"
    echo "Dir::Etc::sourcelist \"$folder.apt/debian.sources\"; Dir::Etc::sourceparts \"/dev/null\";"
  else
    echo "APT::Architecture \"$architecture\"; APT::Architectures { \"$architecture\"; };"
  fi
  echo "APT::Install-Recommends \"false\"; APT::Sandbox::User \"\"; Dir::State \"$folder.apt/state\";"
  echo "Dir::State::status \"$folder.apt/status\"; Dir::Cache \"$folder.apt/cache\";"
} > "$folder.apt/conf"
export APT_CONFIG=$folder.apt/conf
echo "sysroot.sh: fetching $*" >&2
apt-get update -qq >&2
if [ "$architecture" = sources ]; then
  cd "$folder.apt/files"
  for package in "$@"; do
    case "$package" in
      source:*)
        apt-get source -qq --download-only "${package#source:}" >&2
        mkdir -p "$folder/src/${package#source:}"
        tar -xf "${package#source:}"_*.orig.tar.* -C "$folder/src/${package#source:}" --strip-components=1
        ;;
      *) apt-get download -qq "$package" >&2 ;;
    esac
  done
else
  apt-get install -y -qq --download-only "$@" >&2
  mv "$folder.apt/cache/archives"/*.deb "$folder.apt/files"
fi
for package in "$folder.apt/files"/*.deb; do dpkg-deb -x "$package" "$folder"; done
rm -rf "$folder.apt"
echo "$*" > "$folder/packages"

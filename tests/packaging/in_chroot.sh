#!/usr/bin/env bash
# The part of try_packages.sh that runs inside: in_chroot.sh FOLDER
set -euo pipefail
cd "$1"
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
say() { echo "try_packages: $*"; }
# Only what packages ask for themselves: a dependency that is not said must be missed here.
install() { apt-get install -y -qq --no-install-recommends "$@" >apt.log 2>&1 || { cat apt.log; exit 1; }; }
of() { find "$PWD/packages" -name "$1_*.deb"; }

say "the program alone"
install "$(of foretouch)"
foretouch demo --details --output demo.jsonl >demo.txt
grep -q '"format":"foretouch-results"' demo.jsonl
grep -E '^(steps|contacts) ' demo.txt
test -f /usr/lib/systemd/system/foretouch.service
test -s /usr/share/man/man1/foretouch-avatar-check.1
test -s /usr/share/bash-completion/completions/foretouch
test -s /usr/share/zsh/vendor-completions/_foretouch
test -s /usr/share/fish/vendor_completions.d/foretouch.fish
test ! -e /etc/systemd/system/multi-user.target.wants/foretouch.service
test -f /usr/share/doc/foretouch/copyright

say "the C example, with a compiler and nothing else of C++ or CMake"
apt-get purge -y -qq foretouch >apt.log 2>&1
install "$(of 'libforetouch0*')" "$(of libforetouch-dev)"
install gcc libc6-dev pkg-config
example=/usr/share/foretouch/c-example
cc -std=c99 -pedantic -Wall -Wextra -Werror "$example/swing.c" -o swing -lforetouch -lm
./swing | tee swing.txt
grep -q '^contact at t = 0.[34]' swing.txt
# shellcheck disable=SC2046
cc "$example/swing.c" -o swing-pkg-config $(pkg-config --cflags --libs foretouch) -lm
./swing-pkg-config | cmp - swing.txt

say "the C and C++ examples by CMake"
install g++ cmake make
by_cmake() { { cmake "$@" -DCMAKE_BUILD_TYPE=Release && cmake --build "${*: -1}"; } >cmake.log 2>&1 || { cat cmake.log; exit 1; }; }
by_cmake -S "$example" -B c-example
c-example/swing | cmp - swing.txt
by_cmake -S consumer -B cxx-example
cxx-example/consumer

python=$(of python3-foretouch)
if [ -n "$python" ]; then
  say "Python"
  install "$python" "$(of foretouch)"
  python3 -c 'import foretouch; print("foretouch", foretouch.__version__)'
  python3 python-example/hand_through_railing.py
  room=/usr/share/foretouch/examples
  files=("$room/room.obj" "$room/dancer.avatar.json" "$room/dancer.bvh" 6)
  python3 python-example/play_clip.py "${files[@]}" | sort >play-python.txt
  say "whole programs, from files to a loop, in C++ and C"
  by_cmake -S /usr/share/foretouch/cpp-example -B play
  play/play_clip "${files[@]}" | sort | cmp - play-python.txt
  c-example/play_clip "${files[@]}" | sort | cmp - play-python.txt
else
  say "no package for Python among them"
fi

say "all of them together, and away again"
install ./packages/*.deb
apt-get purge -y -qq foretouch 'libforetouch*' python3-foretouch >apt.log 2>&1
if find /usr -name '*foretouch*' | grep .; then
  echo "left behind by the packages" >&2
  exit 1
fi
say "passed"

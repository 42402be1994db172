#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The installing half of ./run and ./test with a made-up system: commands that only write down how
# they were called stand in for dpkg-query, apt-get and sudo.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
. "$root/tools/lib/packages.sh"

scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
mkdir "$scratch/bin"
calls="$scratch/calls"

stand_in() {
  printf '#!/bin/bash\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}
stand_in apt-get "echo \"apt-get \$*\" >>'$calls'"
stand_in sudo "echo sudo >>'$calls'; exec \"\$@\""
printf 'ID=debian\nVERSION_ID=12\n' >"$scratch/debian"
printf 'ID=other\nVERSION_ID=1\n' >"$scratch/other"
export PATH="$scratch/bin:$PATH" RAVE_OS_RELEASE="$scratch/debian"

# Everything asked for is installed, except for the names given.
without() {
  stand_in dpkg-query "for name in \"\${@:3}\"; do case \" $* \" in *\" \$name \"*) ;;
    *) echo \"\$name:amd64 installed\" ;; esac; done"
}
# expect WHAT TEXT PATTERN
expect() {
  grep -q -- "$3" <<<"$2" || { echo "FAILED: $1: no '$3' in: $2"; exit 1; }
}

without ""
: >"$calls"
[ -z "$(rave_install_packages build library check)" ] || { echo "FAILED: said something"; exit 1; }
[ ! -s "$calls" ] || { echo "FAILED: nothing was missing, but: $(cat "$calls")"; exit 1; }

without ccache libfmt-dev clang-16
stand_in id "echo 0"
said="$(rave_install_packages build library)"
expect "names it" "$said" "ccache .*a second build is quick"
expect "names it" "$said" "libfmt-dev .*text formatting"
expect "asks for no more" "$(tail -1 "$calls")" "no-install-recommends ccache libfmt-dev$"
expect "updates first" "$(head -1 "$calls")" "update"

: >"$calls"
stand_in id "echo 1000"
rave_install_packages build >/dev/null
expect "becomes root" "$(head -1 "$calls")" "^sudo$"

: >"$calls"
said="$(RAVE_OS_RELEASE="$scratch/other" rave_install_packages build 2>&1)"
expect "says what it does" "$said" "not Debian 12"
[ ! -s "$calls" ] || { echo "FAILED: installed on another system"; exit 1; }

rm "$scratch/bin/sudo"
for tool in awk sort comm sed env cat bash; do
  ln -s "$(command -v "$tool")" "$scratch/bin/$tool"
done
without_sudo="$(PATH="$scratch/bin" && rave_install_packages build 2>&1 || true)"
expect "names the command" "$without_sudo" "As root, run"
echo ok

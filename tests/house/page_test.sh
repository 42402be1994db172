#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What ./run does about the page when its npm packages cannot be fetched, with a made-up clone: the
# real build.sh, a build.ninja as CMake writes it, and commands that stand in for npm, tsc and vite.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
. "$here/tools/lib/build.sh"

root="$(mktemp -d)"
trap 'rm -rf "$root"' EXIT
build="$root/build/release"
mkdir -p "$root/web/protocol" "$root/schemas" "$build/web" "$root/bin" "$root/tools"
cp "$here/web/build.sh" "$root/web/"
cp "$here/tools/gui_types.py" "$root/tools/"
cp -r "$here/schemas/gui" "$root/schemas/"
echo "{}" >"$root/web/package-lock.json"
cat >"$root/bin/npm" <<'SH'
#!/bin/sh
echo "npm $*" >>"$CALLS"
[ -e "$REGISTRY" ] || { echo "npm error network" >&2; exit 1; }
mkdir -p node_modules/.bin
printf '#!/bin/sh\n' >node_modules/.bin/tsc
printf '#!/bin/sh\nwhile [ "$1" != --outDir ]; do shift; done; mkdir -p "$2"; echo page >"$2/index.html"\n' >node_modules/.bin/vite
chmod +x node_modules/.bin/*
SH
chmod +x "$root/bin/npm"
export CALLS="$root/calls" REGISTRY="$root/registry" RAVE_NPM="$root/bin/npm"
cat >"$build/build.ninja" <<NINJA
rule page
  command = sh $root/web/build.sh $build/share/rave/web $build/web/page.stamp
build web/page.stamp: page $root/web/build.sh
build rave_page: phony web/page.stamp
NINJA
fail() { echo "FAILED: $*"; exit 1; }
page="$build/share/rave/web/index.html"

said="$(rave_build_page release 2>&1)" || fail "without a registry it is an error: $said"
grep -q "The page was not built" <<<"$said" || fail "it does not say so: $said"
[ ! -e "$page" ] || fail "a page without its packages"
[ -e "$build/web/page.stamp" ] || fail "every build waits for the registry"

: >"$REGISTRY"
rave_build_page release >/dev/null 2>&1 || fail "with the registry back"
[ -e "$page" ] || fail "with the registry back there is still no page"

: >"$CALLS"
rm "$REGISTRY"
rave_build_page release >/dev/null 2>&1 || fail "a page that is there is built again"
[ ! -s "$CALLS" ] || fail "the registry is asked for a page that is there: $(cat "$CALLS")"
echo ok

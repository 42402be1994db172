#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What ./run and ./test do about a tool that comes after the build tree, with a made-up clone: the
# real build.sh, test_steps.sh and RaveTools.cmake, and a project with one target that needs a tool.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
. "$here/tools/lib/build.sh"
. "$here/tools/lib/test_steps.sh"

root="$(mktemp -d)"
trap 'rm -rf "$root"' EXIT
mkdir "$root/bin" "$root/tools"
ln -s "$here/tools/lib" "$root/tools/lib"
export PATH="$root/bin:$PATH"
cat >"$root/CMakePresets.json" <<'JSON'
{"version": 3, "configurePresets": [
  {"name": "release", "generator": "Ninja", "binaryDir": "${sourceDir}/build/release"}]}
JSON
cat >"$root/CMakeLists.txt" <<CMAKE
cmake_minimum_required(VERSION 3.25)
project(made_up LANGUAGES NONE)
enable_testing()
include($here/cmake/RaveTools.cmake)
rave_find_tool(RAVE_MADE_UP "the made-up suite" rave-made-up rave-made-up-too)
if(RAVE_MADE_UP)
  add_custom_target(made_up ALL COMMAND \${CMAKE_COMMAND} -E true)
endif()
if(NOT EXISTS "$root/file.here")
  rave_lacks("the suite of a file" $root/file.*)
endif()
rave_write_lacking()
CMAKE
fail() { echo "FAILED: $*"; exit 1; }
tool() { printf '#!/bin/sh\n' >"$root/bin/$1" && chmod +x "$root/bin/$1"; }
has_target() { ninja -C "$root/build/release" -t query made_up >/dev/null 2>&1; }
configured() { rave_configure release 2>&1; }
# step_promised, as ./test calls it, and the verdict of ./test.
promised() {
  steps_begin
  step_promised release 2>&1
  ! steps_end
}

grep -q "Configuring" <<<"$(configured)" || fail "a new tree is not configured"
! has_target || fail "a target without its tool"
[ -z "$(configured)" ] || fail "it is configured again though nothing has come"
said="$(promised)" || fail "./test passes without the suites that it promises: $said"
grep -q "the made-up suite: needs rave-made-up rave-made-up-too" <<<"$said" || fail "no reason: $said"

tool rave-made-up-too
grep -q "the made-up suite: rave-made-up-too has come" <<<"$(configured)" || fail "the tool is not seen"
has_target || fail "the tree does not know the tool that has come"
[ -z "$(configured)" ] || fail "it is configured each time"

: >"$root/file.here"
grep -q "the suite of a file" <<<"$(configured)" || fail "the file is not seen"
[ ! -s "$root/build/release/lacking.txt" ] || fail "it still lacks something"
! said="$(promised)" || fail "./test fails though nothing is missing: $said"
echo ok

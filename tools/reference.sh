#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Writes docs/reference/drivers.md from what the drivers of a build say of themselves.
# usage: tools/reference.sh [BUILD_FOLDER]
set -eu
source=$(cd "$(dirname "$0")/.." && pwd)
build=${1:-"$source/build/release"}
unset RAVE_PLUGIN_PATH
mkdir -p "$source/docs/reference"
"$build/bin/rave" drivers --markdown-reference > "$source/docs/reference/drivers.md.new"
mv "$source/docs/reference/drivers.md.new" "$source/docs/reference/drivers.md"

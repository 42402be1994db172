#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The reference of the installed headers as HTML, made by Doxygen; a warning is an error.
#   tools/docs/api.sh [FOLDER]    (default: build/docs/api)
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
out="${1:-$root/build/docs/api}"
command -v doxygen >/dev/null || { echo "doxygen is missing: apt-get install doxygen"; exit 77; }
mkdir -p "$out"
cd "$root"
{ cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = \"$out\""; } | doxygen -
echo "$out/html/index.html"

#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The reference of the installed headers as HTML, made by Doxygen. A warning is an error, and so is a type
# or function of a namespace without documentation.
#   tools/docs/api.sh [FOLDER]    (default: build/docs/api)
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
out="${1:-$root/build/docs/api}"
command -v doxygen >/dev/null || { echo "doxygen is missing: apt-get install doxygen"; exit 77; }
mkdir -p "$out"
cd "$root"
{ cat docs/Doxyfile; echo "OUTPUT_DIRECTORY = \"$out\""; } | doxygen -

# Types and functions without a word. Members of structs speak for themselves or have a comment of
# their own; libs/sim comes with virtual drivers, which use one of its headers.
undocumented="$({ sed -e 's/^WARN_AS_ERROR.*/WARN_AS_ERROR = NO/' docs/Doxyfile
  printf '%s\n' "OUTPUT_DIRECTORY = \"$out\"" 'GENERATE_HTML = NO' 'WARN_IF_UNDOCUMENTED = YES'
} | doxygen - 2>&1 | sed "s|^$root/||" |
  grep -E 'warning: (Compound|Member .* of namespace) .*not documented' |
  grep -vE '^libs/sim/|Codec<|Member operator' || true)"
if [ -n "$undocumented" ]; then
  echo "$undocumented"
  exit 1
fi
echo "$out/html/index.html"

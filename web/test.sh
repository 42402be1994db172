#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Tests of the page: test.sh unit, or test.sh FILE ARGUMENTS for one that drives a browser.
set -eu
cd "$(dirname "$0")"
if [ ! -d node_modules/vitest ]; then
  echo "The npm packages of the page are missing: build the target rave_page with a registry." >&2
  exit 1
fi
if [ "$1" = unit ]; then exec node_modules/.bin/vitest run; fi
exec node "$@"

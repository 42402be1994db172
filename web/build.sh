#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Builds the page: build.sh FOLDER STAMP. Fetches the npm packages of package-lock.json once; without
# a registry it says so and leaves the page out, which is no error.
set -eu
folder="$1" stamp="$2"
cd "$(dirname "$0")"
npm="${RAVE_NPM:-npm}"
if ! cmp -s package-lock.json node_modules/.rave-lock; then
  echo "Fetching the npm packages of the page (web/package-lock.json)"
  if ! "$npm" ci --no-audit --no-fund --ignore-scripts --loglevel=error; then
    echo "The page was not built, since its npm packages cannot be fetched. All else is complete." >&2
    : >"$stamp"
    exit 0
  fi
  cp package-lock.json node_modules/.rave-lock
fi
python3 ../tools/gui_types.py
node_modules/.bin/tsc --noEmit
node_modules/.bin/vite build --logLevel warn --emptyOutDir --outDir "$folder"
# What authors of panels write against; after vite, which empties the folder.
node_modules/.bin/tsc --project tsconfig.types.json --outDir "$folder/types"
: >"$stamp"

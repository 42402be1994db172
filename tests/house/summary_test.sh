#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The last lines of ./test from made-up results: counts, names and the exit code.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT

expect() {
  grep -q -x -- "$2" <<<"$1" || { echo "FAILED: no line '$2' in: $1"; exit 1; }
}
summary() { python3 "$root/tools/lib/summary.py" "$scratch" 7; }

if said="$(summary)"; then echo "FAILED: nothing ran, and that passed"; exit 1; fi
expect "$said" "0 passed, 0 failed"

label() { echo "{\"name\": \"$1\", \"properties\": [{\"name\": \"LABELS\", \"value\": [\"$2\"]}]}"; }
echo "{\"tests\": [$(label a unit), $(label b unit), $(label c lint)]}" >"$scratch/release.json"
cat >"$scratch/release.xml" <<'TEXT'
<testsuite><testcase name="a" time="1.5" status="run"/><testcase name="b" time="0.5" status="run"/>
<testcase name="c" time="2" status="run"/></testsuite>
TEXT
printf 'release\tbuild\tpassed\t4\n' >"$scratch/notes.tsv"
said="$(summary)" || { echo "FAILED: all passed, and that failed: $said"; exit 1; }
expect "$said" "4 passed, 0 failed"
expect "$said" "release *unit *2 *0 *0 *2.0 *25.0%"
[ "$(tail -1 <<<"$said")" = "4 passed, 0 failed" ]

# One that failed, and one that never got to run.
cat >"$scratch/release.xml" <<'TEXT'
<testsuite><testcase name="a" time="1.5" status="fail"/><testcase name="b" time="0.5" status="run"/>
</testsuite>
TEXT
if said="$(summary)"; then echo "FAILED: failures passed"; exit 1; fi
expect "$said" "2 passed, 2 failed"
expect "$said" "failed: release: a"
expect "$said" "failed: release: c"
echo ok

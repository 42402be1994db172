#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# fused_test.sh LIBRARY ...
# Fails if a library has a fused multiply-add: it rounds once where the other sets of instructions
# round twice, and a run would not give the same bits on every processor. Knows the names of x86.
set -euo pipefail

status=0
for library in "$@"; do
  # `objdump` prints each function's name before its instructions.
  fused="$(objdump --disassemble --demangle --no-show-raw-insn "$library" |
    awk '/^[0-9a-f]+ <.*>:$/ { name = $0 } /[[:space:]]vfn?m(add|sub)/ { print name " " $2 }' | sort -u)"
  if [ -n "$fused" ]; then
    printf '%s has fused multiply-adds:\n%s\n' "${library##*/}" "$fused" >&2
    status=1
  fi
done
exit "$status"

# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154
# The steps of ./test. A step that fails is counted and the next one goes on, so that one run
# shows everything that is wrong. Sourced; needs $root, $fuzz_seconds and tools/lib/build.sh.

steps_begin() {
  report="$root/build/test-report"
  rm -rf "$report"
  mkdir -p "$report"
  SECONDS=0
}

# Notes one thing that is no ctest test: STEP SUITE passed|failed SECONDS.
step_note() {
  printf '%s\t%s\t%s\t%s\n' "$@" >>"$report/notes.tsv"
}

# Builds a preset as a part of the run that can fail: PRESET [targets].
step_build() {
  local begin=$SECONDS result=passed
  rave_build "$@" || result=failed
  step_note "$1" build "$result" $((SECONDS - begin))
  [ "$result" = passed ]
}

# Fails if the tree lacks tools, and with them suites: ./test promises all of them.
step_promised() {
  local result=passed lacking="$root/build/$1/lacking.txt"
  [ ! -s "$lacking" ] || result=failed
  if [ "$result" = failed ]; then
    echo "Suites are missing, because $lacking lists tools that are not there:" >&2
    awk -F '\t' '{ print "  " $2 ": needs " $1 }' "$lacking" >&2
  fi
  step_note "$1" suites "$result" 0
}

# Runs the tests of a built preset: PRESET [ctest options]. The report is called STEP_NAME, or as the
# preset.
step_ctest() {
  local preset="$1" name="${STEP_NAME:-$1}"
  shift
  ctest --test-dir "$root/build/$preset" --show-only=json-v1 "$@" >"$report/$name.json"
  # Tests that mostly wait (WAITS in CMake) take no core, so one test more than cores runs at once.
  printf '{"version":{"major":1,"minor":0},"local":[{"cores":[{"id":"0","slots":%s}]}]}\n' "$(nproc)" \
    >"$report/cores.json"
  # Its exit code is not needed: the report says which tests failed.
  ctest --test-dir "$root/build/$preset" -j "$(($(nproc) + 1))" \
    --resource-spec-file "$report/cores.json" --output-on-failure \
    --no-tests=error --output-junit "$report/$name.xml" "$@" || true
}

step_release() {
  step_build release || return 0
  step_ctest release "$@"
}

# More random moments at which processes are killed than the release step has.
step_kills() {
  step_build release rave_tests_kills rave_page || return 0
  STEP_NAME=kills RAVE_KILL_ROUNDS="${RAVE_KILL_ROUNDS:-50}" \
    RAVE_OVERLOAD_ROUNDS="${RAVE_OVERLOAD_ROUNDS:-3}" step_ctest release -L '^kills$'
}

# Moments of a kill per test under sanitizers, where each takes several times as long. The release
# preset has more of them (step_kills).
sanitized_kill_rounds=2

# Assertions are on here, and the hash of a run does not depend on optimisation.
# Checks of the source do not depend on the preset: release has run them.
step_asan_ubsan() {
  step_build asan-ubsan || return 0
  ASAN_OPTIONS=detect_stack_use_after_return=1:strict_string_checks=1 \
    UBSAN_OPTIONS=print_stacktrace=1 RAVE_KILL_ROUNDS="$sanitized_kill_rounds" \
    step_ctest asan-ubsan -LE '^(lint|headers|docs|no_asan)$'
}

step_tsan() {
  step_build tsan || return 0
  TSAN_OPTIONS="second_deadlock_stack=1:halt_on_error=1:suppressions=$root/tools/tsan.supp" \
    RAVE_KILL_ROUNDS="$sanitized_kill_rounds" step_tsan_ctest -LE '^(lint|headers|docs|no_tsan)$'
}

# A kernel that places memory at very random addresses stops gcc's thread sanitizer.
step_tsan_ctest() {
  if setarch "$(uname -m)" -R true 2>/dev/null; then
    ctest() { command setarch "$(uname -m)" -R ctest "$@"; }
    step_ctest tsan "$@"
    unset -f ctest
  else
    step_ctest tsan "$@"
  fi
}

# The reference reader of records. What is installed stays in tests/record, so that it is fetched
# once; after that nothing here touches the network.
step_record_reader() {
  local begin=$SECONDS result=passed folder="$root/tests/record"
  if ! cmp -s "$folder/package-lock.json" "$folder/node_modules/.rave-lock"; then
    echo "These npm packages will be installed into tests/record/node_modules:"
    node -e 'for (const [name, what] of Object.entries(require(process.argv[1]).packages))
      if (name) console.log("  " + name.replace(/^.*node_modules\//, "") + " " + what.version);' \
      "$folder/package-lock.json"
    (cd "$folder" && npm ci --no-audit --no-fund --ignore-scripts) &&
      cp "$folder/package-lock.json" "$folder/node_modules/.rave-lock" || result=failed
  fi
  step_note record-reader npm "$result" $((SECONDS - begin))
  [ "$result" = passed ] || return 0
  step_build release rave-write-sample-record || return 0
  begin=$SECONDS
  node "$folder/check_mcap.mjs" "$root/build/release/bin/rave-write-sample-record" \
    "$root/build/release" || result=failed
  step_note record-reader check "$result" $((SECONDS - begin))
}

step_tidy() {
  local begin=$SECONDS
  if ! rave_configure tidy; then
    step_note tidy build failed $((SECONDS - begin))
    return 0
  fi
  ninja -C "$root/build/tidy" build.ninja rave_generated >/dev/null
  python3 "$root/tools/tidy.py" --build "$root/build/tidy" --notes "$report/notes.tsv" || true
}

step_long_fuzz() {
  rave_configure fuzz || { step_note long-fuzz build failed 0; return 0; }
  step_build fuzz rave_fuzzers || return 0
  python3 "$root/tools/fuzz.py" --build "$root/build/fuzz" --seconds "$fuzz_seconds" \
    --notes "$report/notes.tsv" || true
}

steps_end() {
  python3 "$root/tools/lib/summary.py" "$report" "$SECONDS"
}

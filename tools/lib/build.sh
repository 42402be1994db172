# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154
# Configures and builds presets. Sourced; needs $root, the folder of the clone.

rave_build_environment() {
  export CCACHE_DIR="${CCACHE_DIR:-${XDG_CACHE_HOME:-${HOME:-$root/build}/.cache}/ccache}"
  export CCACHE_BASEDIR="$root"
  # Paths in debug information are cut off by the compiler flags, so the folder does not count.
  export CCACHE_NOHASHDIR=1
  # A fresh clone has fresh times; the content decides.
  export CCACHE_SLOPPINESS="${CCACHE_SLOPPINESS:-include_file_ctime,include_file_mtime}"
}

# Shows what ninja says: one line that changes on a terminal, else a line each tenth of the work;
# compiler messages always in full.
rave_show_progress() {
  local label="$1" line tenth last=-1 done_count total terminal=0
  [ -t 1 ] && terminal=1
  while IFS= read -r line; do
    if [[ "$line" =~ ^\[([0-9]+)/([0-9]+)\] ]]; then
      done_count="${BASH_REMATCH[1]}" total="${BASH_REMATCH[2]}"
      if [ "$terminal" = 1 ]; then
        printf '\r%s: %s of %s \e[K' "$label" "$done_count" "$total"
        continue
      fi
      tenth=$((done_count * 10 / total))
      [ "$tenth" = "$last" ] || echo "$label: $done_count of $total"
      last="$tenth"
    elif [ "$line" != "ninja: no work to do." ]; then
      [ "$terminal" = 1 ] && printf '\r\e[K'
      printf '%s\n' "$line"
    fi
  done
  [ "$terminal" = 1 ] && printf '\r\e[K'
  return 0
}

# Whether something is there now that the build tree FOLDER lacked when it was configured: a program,
# or a file by its pattern (cmake/RaveTools.cmake).
rave_tool_has_come() {
  local names part name
  [ -f "$1/lacking.txt" ] || return 1
  while IFS=$'\t' read -r names part; do
    for name in $names; do
      if command -v "$name" >/dev/null || { [[ "$name" = /* ]] && compgen -G "$name" >/dev/null; }; then
        echo "$part: $name has come"
        return 0
      fi
    done
  done <"$1/lacking.txt"
  return 1
}

# rave_configure PRESET [cmake options]: only if there is no build tree yet, or if a tool that it lacked
# has come; otherwise ninja configures again by itself when a CMake file changes.
rave_configure() {
  local preset="$1" folder="$root/build/$1" log="$root/build/$1-configure.log"
  shift
  if [ -f "$folder/build.ninja" ] && [ $# = 0 ] && ! rave_tool_has_come "$folder"; then
    return 0
  fi
  mkdir -p "$root/build"
  echo "Configuring $preset"
  if ! (cd "$root" && cmake --preset "$preset" "$@") >"$log" 2>&1; then
    cat "$log" >&2
    return 1
  fi
}

# rave_build PRESET [targets]: everything if no target is named.
rave_build() {
  local preset="$1"
  shift
  rave_configure "$preset" || return
  # The pipe hides the status of ninja from `set -e`; PIPESTATUS has it.
  ninja -C "$root/build/$preset" -j "$(nproc)" "$@" 2>&1 |
    grep --line-buffered -v '^ninja: Entering directory' | rave_show_progress "Building $preset"
  return "${PIPESTATUS[0]}"
}

# rave_build_page PRESET: the page of the GUI Server. One whose packages could not be fetched is tried
# again: its stamp, which keeps other builds from waiting for the registry each time, says nothing of
# the page.
rave_build_page() {
  if [ ! -f "$root/build/$1/share/rave/web/index.html" ]; then
    rm -f "$root/build/$1/web/page.stamp"
  fi
  rave_build "$1" rave_page
}

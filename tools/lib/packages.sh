# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154
# Installs what is missing of tools/packages.txt. Sourced; needs $root, the folder of the clone.

# The command that a package is missed by on systems that are not Debian 12.
rave_tools_of_group() {
  case "$1" in
    build) echo "g++ cmake ninja ccache pkg-config git python3" ;;
    library) echo "idlc" ;;
    page) echo "node npm" ;;
    check) echo "clang-format-16 readelf nm ip nft" ;;
    full) echo "clang++-16 clang-tidy-16" ;;
  esac
}

rave_is_debian_12() {
  local file="${RAVE_OS_RELEASE:-/etc/os-release}"
  # shellcheck disable=SC1090
  [ -r "$file" ] && (. "$file" && [ "${ID:-}" = debian ] && [ "${VERSION_ID:-}" = 12 ])
}

# Says so on another system and goes on if the tools of the groups are there.
rave_check_other_system() {
  local group tool missing=""
  echo "This is not Debian 12, so nothing is installed here; going on with what there is." >&2
  for group in "$@"; do
    for tool in $(rave_tools_of_group "$group"); do
      command -v "$tool" >/dev/null || missing="$missing $tool"
    done
  done
  if [ -n "$missing" ]; then
    echo "Missing:$missing. tools/packages.txt lists what is needed and why." >&2
    return 1
  fi
}

# The command for whose sake alone a package is asked for: one from another source serves as well,
# and the package could not be installed beside it.
rave_command_of_package() {
  case "$1" in
    nodejs) echo node ;;
    npm) echo npm ;;
  esac
}

# rave_missing_packages GROUP...: their names, one per line.
rave_missing_packages() {
  local wanted installed
  wanted="$(awk -v groups=" $* " '!/^#/ && NF && index(groups, " " $1 " ") { print $2 }' \
    "$root/tools/packages.txt")"
  # An unknown package makes dpkg-query fail; the others are still listed.
  # shellcheck disable=SC2086
  installed="$(dpkg-query -W -f='${binary:Package} ${db:Status-Status}\n' $wanted 2>/dev/null |
    awk '$2 == "installed" { sub(/:.*/, "", $1); print $1 }')" || true
  local name command
  for name in $(comm -23 <(sort -u <<<"$wanted") <(sort -u <<<"$installed")); do
    command="$(rave_command_of_package "$name")"
    [ -n "$command" ] && command -v "$command" >/dev/null || echo "$name"
  done
}

# rave_install_packages GROUP...: names what is missing and why, then installs it. Touches neither
# the network nor the system if nothing is missing.
rave_install_packages() {
  rave_is_debian_12 || { rave_check_other_system "$@"; return; }
  local missing name become=()
  missing="$(rave_missing_packages "$@")"
  [ -n "$missing" ] || return 0
  echo "These Debian packages are missing and will be installed:"
  for name in $missing; do
    awk -v name="$name" '!/^#/ && $2 == name { $1 = ""; package = $2; $2 = ""; sub(/^ +/, "")
      printf "  %-20s %s\n", package, $0 }' "$root/tools/packages.txt"
  done
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Installing needs root, and there is no sudo. As root, run:" >&2
      # shellcheck disable=SC2086
      echo "  apt-get install --no-install-recommends ${missing//$'\n'/ }" >&2
      return 1
    fi
    become=(sudo)
  fi
  # In this form sudo passes the variable on as well.
  "${become[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq || return
  # shellcheck disable=SC2086
  "${become[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq \
    --no-install-recommends $missing
}

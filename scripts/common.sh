# SPDX-License-Identifier: BSD-3-Clause
# Sourced by the other scripts: where things are, packages, builds.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
jobs=${MLSMESH_JOBS:-$(nproc)}

# Prints what is not installed of the packages that the given lists name.
missing_packages() {
  local package
  grep -hv -e '^#' -e '^$' "$@" | while read -r package; do
    if [ "$(dpkg-query -W -f '${Status}' "$package" 2> /dev/null)" != "install ok installed" ]; then
      echo "$package"
    fi
  done
}

# Installs what is missing of the packages that the given lists name; asks nothing of a machine that has them all.
install_packages() {
  local packages
  mapfile -t packages < <(missing_packages "$@")
  [ "${#packages[@]}" -gt 0 ] || return 0
  if ! command -v apt-get > /dev/null; then
    echo "$0: apt-get: not found; install the equivalents of: ${packages[*]}" >&2
    return 1
  fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo > /dev/null || { echo "$0: sudo: not found; as root: apt-get install ${packages[*]}" >&2; return 1; }
    as_root=(sudo)
  fi
  echo "Installing ${packages[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${packages[@]}"
}

# build_preset NAME [TARGET...]: configures build/NAME unless that is done, and brings the targets up to date.
build_preset() {
  local preset=$1
  shift
  if [ ! -f "$root/build/$preset/build.ninja" ]; then
    (cd "$root" && cmake --preset "$preset" ${CI:+-DMLSMESH_WARNINGS_AS_ERRORS=ON})
  fi
  cmake --build "$root/build/$preset" -j "$jobs" ${1:+--target "$@"}
}

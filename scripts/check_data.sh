#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_data.sh [--all]: meshes real clouds from ${MLSMESH_DATA_DIR:-../shared/data} and checks every level: sound, free of self-intersections, and of
# the topology that data_topology.txt names. --all: also soundness for every other cloud that is there. The program is that of
# build/release, or of the preset that MLSMESH_PRESET names.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

data=${MLSMESH_DATA_DIR:-$root/../shared/data}
if [ ! -d "$data" ]; then
  echo "WARNING: check_data: no folder $data, real data are not checked; name it in MLSMESH_DATA_DIR"
  exit 0
fi
program=$root/build/${MLSMESH_PRESET:-release}/bin/mlsmesh_reconstruct
[ -x "$program" ] || { echo "check_data: $program: not built; run scripts/setup.sh" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0
failed=0

# values KEY: the value of KEY at every level, in one line.
values() {
  sed -n "s/^ *\"$1\": \([-a-z0-9.]*\),*$/\1/p" "$work/mesh.json" | tr '\n' ' '
}

# all_within LOW HIGH VALUE...: whether all are numbers in that range, and there is one at least.
all_within() {
  local low=$1 high=$2 value
  shift 2
  [ $# -gt 0 ] || return 1
  for value in "$@"; do
    [[ $value =~ ^[0-9]+$ ]] && [ "$value" -ge "$low" ] && [ "$value" -le "$high" ] || return 1
  done
}

# check KEY LOW HIGH: as all_within for the values of KEY, and says what is wrong.
check() {
  local found
  found=$(values "$1")
  # shellcheck disable=SC2086
  all_within "$2" "$3" $found && return 0
  echo "  $1 by level: $found; wanted $2 .. $3"
  return 1
}

check_soundness() {
  local key good=true
  for key in nonmanifold_edges nonmanifold_vertices orientation_conflicts degenerate_faces duplicate_faces isolated_vertices \
    self_intersections; do
    check "$key" 0 0 || good=false
  done
  $good
}

# check_cloud NAME [COMPONENTS GENUS LOOPS_LOW LOOPS_HIGH]
check_cloud() {
  local name=$1 good=true
  echo "$name"
  if "$program" "$data/$name.pcd" "$work/mesh.ply" --quiet --json "$work/mesh.json"; then
    check_soundness || good=false
    if [ $# -gt 1 ]; then
      check components "$2" "$2" || good=false
      check genus "$3" "$3" || good=false
      check border_loops "$4" "$5" || good=false
    fi
  else
    good=false
  fi
  rm -f "$work"/*
  if $good; then passed=$((passed + 1)); else failed=$((failed + 1)); echo "  FAILED"; fi
}

known=' '
while read -r name components genus low high; do
  [[ -n $name && $name != '#'* ]] || continue
  known+="$name "
  if [ -f "$data/$name.pcd" ]; then
    check_cloud "$name" "$components" "$genus" "$low" "$high"
  else
    echo "WARNING: check_data: $data/$name.pcd is absent and not checked"
  fi
done < "$root/scripts/data_topology.txt"

if [ "${1:-}" = --all ]; then
  for file in "$data"/cloud/*.pcd "$data"/sampled/*.pcd; do
    [ -f "$file" ] || continue
    name=${file#"$data"/}
    name=${name%.pcd}
    [[ $known == *" $name "* ]] || check_cloud "$name"
  done
fi

echo "check_data: $passed clouds passed, $failed failed"
[ "$failed" -eq 0 ]

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_random_scans.sh [COUNT [SEED]]: meshes COUNT (200) virtual scans of surfaces that are known exactly, their shape,
# number of points, density, noise (up to half a spacing), outliers and scanner positions drawn at random from SEED (1).
# Every level must be sound and free of self-intersections in all of them, and the topology that of the surface in 98 of 100;
# of a scan that did not see the whole surface it is asked that no handle is invented. Prints the two commands that repeat
# each failure. The programs are those of build/release, or of the preset that MLSMESH_PRESET names.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

count=${1:-200}
state=${2:-1}
bin=$root/build/${MLSMESH_PRESET:-release}/bin
for program in mlsmesh_sample mlsmesh_reconstruct; do
  [ -x "$bin/$program" ] || { echo "check_random_scans: $bin/$program: not built; run scripts/setup.sh" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Sets `drawn` to a number of 0 .. $1 - 1 (the generator of Numerical Recipes; its high bits).
draw() {
  state=$(((state * 1664525 + 1013904223) % 4294967296))
  drawn=$((state / 65536 % $1))
}

# Median distance of nearest neighbours, times the root of the number of points, over the diagonal of the shape.
declare -A spacing=([sphere]=0.480 [torus]=0.464 [saddle]=0.360 [cylinder]=0.490 [moebius]=0.285 [figure]=0.433)
declare -A genus=([sphere]=0 [torus]=1 [saddle]=0 [cylinder]=0 [moebius]=0 [figure]=1)
declare -A loops=([sphere]=0 [torus]=0 [saddle]=1 [cylinder]=2 [moebius]=1 [figure]=1) # the Moebius band is cut open
shapes=(sphere torus saddle cylinder moebius figure)

# draw_scan: a shape and the arguments of its scan, in `shape`, `arguments` and `views`.
draw_scan() {
  draw ${#shapes[@]}
  shape=${shapes[drawn]}
  local fewest=2000 tenths
  [ "$shape" != figure ] || fewest=20000 # its tail and tusks are thin
  draw 30000
  local points=$((fewest + drawn))
  arguments=(--count "$points")
  draw 6
  tenths=$drawn
  arguments+=(--noise "$(awk -v t="$tenths" -v c="${spacing[$shape]}" -v n="$points" 'BEGIN { printf "%.6f", t / 10 * c / sqrt(n) }')")
  draw 3
  if [ "$drawn" -eq 0 ]; then
    draw 3
    local axis=$((drawn + 1))
    draw 9
    arguments+=(--density "$(cut -d' ' -f$axis <<< 'x y z'),$((drawn + 2))")
  fi
  draw 4
  if [ "$drawn" -eq 0 ]; then arguments+=(--outliers 0.02); fi
  draw 5
  views=0
  if [ "$drawn" -eq 0 ]; then
    draw 6
    views=$((drawn + 3))
    arguments+=(--views "$views")
  fi
  draw 1000
  arguments+=(--seed "$drawn" --quiet)
}

# values KEY: the value of KEY at every level, in one line.
values() {
  sed -n "s/^ *\"$1\": \([-a-z0-9.]*\),*$/\1/p" "$work/mesh.json" | tr '\n' ' '
}

# faults: what is wrong with the mesh of the scan, apart from its topology.
faults() {
  local key found
  for key in nonmanifold_edges nonmanifold_vertices orientation_conflicts degenerate_faces duplicate_faces isolated_vertices self_intersections; do
    found=$(values $key)
    [[ $found =~ ^(0 )+$ ]] || echo -n "$key $found"
  done
}

# wrong_topology: components, genus and border loops where they are not those of the surface.
wrong_topology() {
  local found_components found_genus found_loops
  found_components=$(values components)
  found_genus=$(values genus)
  found_loops=$(values border_loops)
  if [ "$views" -gt 0 ]; then
    local most=${found_genus%% *}
    [[ $most =~ ^[0-9]+$ ]] && [ "$most" -le "${genus[$shape]}" ] || echo "genus $found_genus"
  elif ! [[ $found_components =~ ^(1 )+$ && $found_genus =~ ^(${genus[$shape]} )+$ && $found_loops =~ ^(${loops[$shape]} )+$ ]]; then
    echo "components $found_components genus $found_genus border loops $found_loops"
  fi
}

unsound=0
wrong=0
for ((scan = 0; scan < count; ++scan)); do
  draw_scan
  "$bin/mlsmesh_sample" "$shape" "$work/scan.pcd" "${arguments[@]}"
  problem=
  if ! "$bin/mlsmesh_reconstruct" "$work/scan.pcd" "$work/mesh.ply" --quiet --json "$work/mesh.json"; then
    problem="no mesh"
  else
    problem=$(faults)
  fi
  if [ -n "$problem" ]; then
    unsound=$((unsound + 1))
  else
    problem=$(wrong_topology)
    [ -z "$problem" ] || wrong=$((wrong + 1))
  fi
  [ -z "$problem" ] || printf '%s\n  mlsmesh_sample %s scan.pcd %s\n  mlsmesh_reconstruct scan.pcd mesh.ply\n' "$problem" "$shape" "${arguments[*]}"
done

echo "check_random_scans: $count scans, $unsound unsound, $wrong of wrong topology"
[ "$unsound" -eq 0 ] && [ $((100 * wrong)) -le $((2 * count)) ]

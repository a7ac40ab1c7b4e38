#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_determinism.sh BIN [OTHER_BIN]: meshes scans, generated ones and real ones of ${MLSMESH_DATA_DIR:-../shared/data}, with the
# programs of folder BIN in several ways (defaults, no reduction, every stage that may be switched on) and compares the bytes of
# every level: on 1, 2, 3 and 8 threads, in a second run, with the points of the file shuffled, and with the programs of OTHER_BIN,
# which another compiler made.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

bin=$(realpath "${1:?name the folder of the programs}")
other=${2:+$(realpath "$2")}
data=${MLSMESH_DATA_DIR:-$root/../shared/data}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
compared=0

# digest_of PROGRAM CLOUD OPTIONS...: one line for the bytes of all levels.
digest_of() {
  local program=$1 cloud=$2
  shift 2
  rm -rf "$work/levels"
  mkdir "$work/levels"
  "$program" "$cloud" "$work/levels/mesh.ply" --all-levels --quiet "$@" 2> "$work/log" || { cat "$work/log" >&2; exit 1; }
  (cd "$work/levels" && sha256sum -- *.ply | sha256sum)
}

# same WHAT DIGEST EXPECTED
same() {
  compared=$((compared + 1))
  [ "$2" = "$3" ] && return 0
  echo "check_determinism: $name ${ways[*]:-} differs: $1" >&2
  exit 1
}

# Shuffles the lines after the header of an ASCII PCD file, by a seed.
shuffle() {
  awk -v seed="$1" 'BEGIN { srand(seed) } done { print rand() "\t" $0; next } { print "0\t" $0 > "/dev/stderr" } /^DATA ascii/ { done = 1 }' \
    "$2" 2> "$work/header" | sort -g | cut -f2- > "$work/lines"
  cut -f2- "$work/header" | cat - "$work/lines"
}

# check_scan ASCII_PCD OPTIONS...
check_scan() {
  local cloud=$1 expected
  shift
  ways=("$@")
  expected=$(digest_of "$bin/mlsmesh_reconstruct" "$cloud" --threads 1 "$@")
  for threads in 1 2 3 8; do
    same "$threads threads" "$(digest_of "$bin/mlsmesh_reconstruct" "$cloud" --threads "$threads" "$@")" "$expected"
  done
  shuffle 7 "$cloud" > "$work/shuffled.pcd"
  same "points shuffled" "$(digest_of "$bin/mlsmesh_reconstruct" "$work/shuffled.pcd" "$@")" "$expected"
  [ -z "$other" ] || same "programs of $other" "$(digest_of "$other/mlsmesh_reconstruct" "$cloud" "$@")" "$expected"
}

check_all_ways() {
  check_scan "$1"
  check_scan "$1" --no-reduction
  check_scan "$1" --watertight --levels 1
  check_scan "$1" --preset paper
}

for shape in figure torus moebius; do
  name=$shape
  "$bin/mlsmesh_sample" "$shape" "$work/cloud.xyz" --count 20000 --noise 0.001 --outliers 0.01 --quiet
  {
    printf 'VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH %d\nHEIGHT 1\n' "$(wc -l < "$work/cloud.xyz")"
    printf 'VIEWPOINT 0 0 0 1 0 0 0\nPOINTS %d\nDATA ascii\n' "$(wc -l < "$work/cloud.xyz")"
    cut -d' ' -f1-3 "$work/cloud.xyz"
  } > "$work/cloud.pcd"
  check_all_ways "$work/cloud.pcd"
done
for name in cloud/bunny_35947 sampled/fandisk_30k_noise0p25 cloud/rops_points; do
  if [ ! -f "$data/$name.pcd" ] || ! command -v pcl_convert_pcd_ascii_binary > /dev/null; then
    echo "WARNING: check_determinism: $data/$name.pcd or pcl_convert_pcd_ascii_binary is absent; not checked"
    continue
  fi
  pcl_convert_pcd_ascii_binary "$data/$name.pcd" "$work/cloud.pcd" 0 9 > /dev/null 2>&1
  check_all_ways "$work/cloud.pcd"
done
echo "check_determinism: $compared comparisons, all the same to the byte"

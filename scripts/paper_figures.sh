#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# paper_figures.sh [DATA]: docs/paper.jpg, the figures of the paper with its preset: bunny and horse as cloud, clusters, representatives
# and levels 0, 1 and 2. DATA is ${MLSMESH_DATA_DIR:-../shared/data}; the programs are those of build/release, or of the folder MLSMESH_BIN.
# Needs ImageMagick (Debian's imagemagick).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

data=${1:-${MLSMESH_DATA_DIR:-$root/../shared/data}}
view=${MLSMESH_BIN:-$root/build/release/bin}/mlsmesh_view
command -v montage > /dev/null || { echo "paper_figures: montage: not installed (package imagemagick)" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# draw NAME CLOUD OPTION...: NAME_1.png to NAME_6.png, each of one kind.
draw() {
  local name=$1 cloud=$data/$2
  shift 2
  [ -f "$cloud" ] || { echo "paper_figures: no $cloud; name the folder of the clouds" >&2; exit 1; }
  "$view" "$cloud" --config "$root/launch_configs/reconstruct/$name.cfg" --threads 1 --size 400x380 --no-labels --flat "$@" \
    --script "wait,c,p=$work/${name}_1.png,k,p=$work/${name}_2.png,n,p=$work/${name}_3.png,\
m,Down,Down,g,p=$work/${name}_4.png,Up,p=$work/${name}_5.png,Up,g,p=$work/${name}_6.png,q"
}

draw bunny cloud/bunny_35947.pcd --view front
draw horse cloud/horse_48485.pcd --up z --view front
montage "$work"/bunny_[1-6].png "$work"/horse_[1-6].png -tile 3x4 -geometry +3+3 "$work/all.png"
convert "$work/all.png" -strip -quality 70 "$root/docs/paper.jpg"
echo "docs/paper.jpg: $(stat -c %s "$root/docs/paper.jpg") bytes"

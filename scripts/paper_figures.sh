#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# paper_figures.sh [DATA [MODEL...]]: docs/paper_MODEL.jpg, the figures of the paper with its preset: each of its models, or those named, as cloud,
# clusters, representatives and levels 0, 1 and 2. DATA is ${MLSMESH_DATA_DIR:-../shared/data}; the programs are those of build/release, or of
# the folder MLSMESH_BIN. Needs ImageMagick (Debian's imagemagick).
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

data=${1:-${MLSMESH_DATA_DIR:-$root/../shared/data}}
models=("${@:2}")
[ "${#models[@]}" -gt 0 ] || models=(cactus cat club bunny horse dragon)
view=${MLSMESH_BIN:-$root/build/release/bin}/mlsmesh_view
command -v montage > /dev/null || { echo "paper_figures: montage: not installed (package imagemagick)" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# draw NAME CLOUD SET OPTION...: work/SET_1.png to SET_6.png, the six kinds in the order of the paper, at twice the size of the figure, for fine lines.
draw() {
  local name=$1 cloud=$data/$2 to=$work/$3
  shift 3
  [ -f "$cloud" ] || { echo "paper_figures: no $cloud; name the folder of the clouds" >&2; exit 1; }
  "$view" "$cloud" --config "$root/launch_configs/reconstruct/$name.cfg" --threads 1 --size 800x760 --flat "$@" \
    --script "wait,c,minus,minus,p=${to}_1.png,k,plus,plus,plus,p=${to}_2.png,n,minus,minus,p=${to}_3.png,\
m,Down,Down,g,p=${to}_4.png,Up,p=${to}_5.png,Up,g,p=${to}_6.png,q"
}

for model in "${models[@]}"; do
  case $model in
    cactus) draw cactus cloud/cactus_3337.pcd cactus --up z --view front ;;
    cat) draw cat cloud/cat_10000.pcd cat --up z --view back ;;
    club) draw club cloud/club_16864.pcd club --up z --view top ;;
    bunny) draw bunny cloud/bunny_35947.pcd bunny --view front ;;
    horse) draw horse cloud/horse_48485.pcd horse --up z --view front ;;
    dragon)
      draw dragon sampled/dragon_437645_standin.pcd dragon --view front
      draw dragon sampled/dragon_437645_standin.pcd detail --view front --zoom 5 --no-labels
      for kind in 3 4 5; do mv "$work/detail_$kind.png" "$work/dragon_$kind.png"; done
      ;;
    *) echo "paper_figures: $model: not a model of the paper" >&2; exit 2 ;;
  esac
  picture=docs/paper_$model.jpg
  montage "$work/${model}"_[1-6].png -resize 400x380 -tile 3x2 -geometry +3+3 "$work/all.png"
  convert "$work/all.png" -strip -quality 75 "$root/$picture"
  echo "$picture: $(stat -c %s "$root/$picture") bytes"
done

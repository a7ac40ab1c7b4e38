#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Shows the whole method: a virtual scan of a figure, its meshes at three levels and pictures of them, in out/demo.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

"$root/scripts/setup.sh"
bin=$root/build/release/bin
out=$root/out/demo
mkdir -p "$out"

"$bin/mlsmesh_sample" figure "$out/figure.pcd" --count 40000 --noise 0.0002 --seed 1
"$bin/mlsmesh_reconstruct" "$out/figure.pcd" "$out/figure.ply" --levels 2 --all-levels --json "$out/figure.json"

"$bin/mlsmesh_view" "$out/figure.pcd" --size 1000x900 --screenshot "$out/cloud.png"
for level in L0 L1 L2; do
  "$bin/mlsmesh_view" "$out/figure.$level.ply" --flat --size 1000x900 --screenshot "$out/$level.png"
done
"$bin/mlsmesh_view" "$out/figure.pcd" "$out"/figure.L[0-2].ply --flat --size 2400x560 --screenshot "$out/levels.png"
"$bin/mlsmesh_view" "$out/figure.pcd" --size 560x520 --script "wait,c,p=$out/mode_cloud.png,k,p=$out/mode_clusters.png,\
n,p=$out/mode_representatives.png,m,Down,Down,g,p=$out/mode_mesh.png,g,Up,Up,b,v,v,v,v,v,v,p=$out/mode_borders.png,\
v,Down,Down,t,p=$out/mode_distance.png,q"
echo "Meshes and pictures are in $out"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_pcl_viewer.sh [--quick] [BIN]: whether PCL's own tools show what we write. Opens meshes of every level, with and without colour, in
# pcl_viewer on a virtual display: VTK directly, PLY as PCL's converters read it (pcl_viewer itself takes PCD and VTK alone). Each
# picture must differ from that of an empty scene, coloured from uncoloured, smooth shading (by the file's normals) from flat, points
# with normals from those without. --quick: the coloured finest level alone. BIN is the folder of the programs, default build/release/bin.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

quick=false
if [ "${1:-}" = --quick ]; then
  quick=true
  shift
fi
bin=${1:-$root/build/release/bin}
for tool in Xvfb import compare pcl_viewer pcl_ply2vtk pcl_ply2pcd; do
  command -v "$tool" > /dev/null || { echo "check_pcl_viewer: $tool: not found; apt-get install xvfb imagemagick pcl-tools" >&2; exit 1; }
done
work=$(mktemp -d)
display_pid=
viewer_pid=
finish() {
  [ -z "$viewer_pid" ] || kill "$viewer_pid" 2> /dev/null || true
  [ -z "$display_pid" ] || kill "$display_pid" 2> /dev/null || true
  rm -rf "$work"
}
trap finish EXIT

fail() {
  echo "check_pcl_viewer: $*" >&2
  exit 1
}

start_display() {
  mkfifo "$work/number"
  Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp -noreset 3> "$work/number" 2> /dev/null &
  display_pid=$!
  DISPLAY=:$(head -n 1 "$work/number")
  export DISPLAY
}

# differing A B: pixels in which two pictures differ.
differing() {
  compare -metric AE "$1" "$2" null: 2>&1 | grep -oE '^[0-9.e+]+' | awk '{printf "%d", $1}' || true
}

# photograph NAME ARGUMENT...: what pcl_viewer draws, as NAME.png: the first of its pictures that fills the screen and stays as it is, but for
# the frames per second that it counts.
photograph() {
  local name=$1 try
  shift
  pcl_viewer "$@" -bc 0.2,0.2,0.2 -cam 0.1,100/0,0,0/3,2,6/0,1,0/0.5/640,480/0,0 > "$work/$name.log" 2>&1 &
  viewer_pid=$!
  for try in $(seq 60); do
    sleep 0.25
    kill -0 "$viewer_pid" 2> /dev/null || { cat "$work/$name.log" >&2; fail "$name: pcl_viewer ended"; }
    import -window root "$work/$name.png"
    [ "$try" -gt 1 ] && [ "$(differing "$work/$name.png" "$work/screen.png")" -gt 20000 ] &&
      [ "$(differing "$work/$name.png" "$work/last.png")" -lt 500 ] && break
    cp "$work/$name.png" "$work/last.png"
  done
  kill "$viewer_pid"
  wait "$viewer_pid" 2> /dev/null || true
  viewer_pid=
}

# expect_different A B LEAST: their pictures differ in that many pixels.
expect_different() {
  local pixels
  pixels=$(differing "$work/$1.png" "$work/$2.png")
  [ "${pixels:-0}" -ge "$3" ] || fail "$1 looks like $2: $pixels pixels differ, $3 should"
  echo "$1: $pixels pixels differ from $2"
}

# A ball of points, once without colour and once with: x, y, z, r, g, b of every point.
make_clouds() {
  awk -v n=2000 'BEGIN {
    for (i = 0; i < n; ++i) {
      z = 1 - 2 * (i + 0.5) / n; r = sqrt(1 - z * z); a = 2.399963229728653 * i
      printf "%.9g %.9g %.9g %d %d %d\n", r * cos(a), r * sin(a), z, 250 * (z > 0), 128, 250 * (z < 0)
    }
  }' > "$work/all.txt"
  cut -d' ' -f1-3 "$work/all.txt" > "$work/plain.xyz"
  {
    printf 'ply\nformat ascii 1.0\nelement vertex 2000\n'
    printf 'property float %s\n' x y z
    printf 'property uchar %s\n' red green blue
    printf 'end_header\n'
    cat "$work/all.txt"
  } > "$work/color.ply"
  # One point far behind the camera: a scene with nothing to be seen.
  printf 'VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n0 0 500\n' \
    > "$work/empty.pcd"
}

# mesh NAME CLOUD EXTENSION: reconstructs into NAME.L0.EXTENSION, NAME.L1.EXTENSION.
mesh() {
  "$bin/mlsmesh_reconstruct" "$2" "$work/$1.$3" --levels 1 --all-levels --quiet
}

# show NAME FILE: a picture of a VTK file, which must not be empty.
show() {
  photograph "$1" "$2"
  expect_different "$1" empty 10000
}

make_clouds
start_display
import -window root "$work/screen.png"
photograph empty "$work/empty.pcd"

# show_level KIND LEVEL: the mesh of that level as VTK, and as PLY.
show_level() {
  show "vtk_$1_$2" "$work/mesh_$1.$2.vtk"
  pcl_ply2vtk "$work/mesh_$1.$2.ply" "$work/from_ply.vtk" > /dev/null 2>&1 || fail "pcl_ply2vtk refuses mesh_$1.$2.ply"
  show "ply_$1_$2" "$work/from_ply.vtk"
}

# show_normals KIND: those of the finest level, as lines at its vertices and by smooth shading.
show_normals() {
  pcl_ply2pcd "$work/mesh_$1.L1.ply" "$work/from_ply.pcd" > /dev/null 2>&1 || fail "pcl_ply2pcd refuses mesh_$1.L1.ply"
  photograph "points_$1" "$work/from_ply.pcd" -ps 3 -fc 200,0,0
  photograph "normals_$1" "$work/from_ply.pcd" -ps 3 -fc 200,0,0 -normals 1 -normals_scale 0.2
  expect_different "normals_$1" "points_$1" 10000
  photograph "smooth_$1" "$work/mesh_$1.L1.vtk" -shading gouraud
  expect_different "smooth_$1" "vtk_$1_L1" 10000
}

mesh mesh_color "$work/color.ply" vtk
mesh mesh_color "$work/color.ply" ply
show_level color L1
if $quick; then
  echo "check_pcl_viewer: passed"
  exit 0
fi
show_normals color
mesh mesh_plain "$work/plain.xyz" vtk
mesh mesh_plain "$work/plain.xyz" ply
show_level plain L1
show_normals plain
show_level plain L0
show_level color L0
for level in L0 L1; do
  expect_different "vtk_color_$level" "vtk_plain_$level" 10000
  expect_different "ply_color_$level" "ply_plain_$level" 10000
done
echo "check_pcl_viewer: passed"

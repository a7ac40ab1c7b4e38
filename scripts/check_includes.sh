#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Checks what may include what: the core nothing of PCL, VTK, Boost or FLANN; no step another step; no cycles.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
cd "$root"

faults=0
fault() {
  echo "check_includes: $*" >&2
  faults=$((faults + 1))
}

foreign=$(grep -rnE '#include [<"](pcl|vtk|boost|flann|X11|nlohmann)' include/mlsmesh/core src/core || true)
[ -z "$foreign" ] || fault "the core knows Eigen and the standard library only: $foreign"

plain='core/[a-z_]+|parameters|status|progress|mesh_report|version'
upward=$(grep -rnE '#include "(mlsmesh|apps)/' include/mlsmesh/core src/core | grep -vE "\"mlsmesh/($plain)\.h\"" || true)
[ -z "$upward" ] || fault "the core must not include what stands above it: $upward"

steps='bsp_clustering|mls_reduction|advancing_front|advancing_front_triangulation|mls_refinement'
for step in bsp_clustering mls_reduction advancing_front advancing_front_triangulation mls_refinement; do
  for file in include/mlsmesh/$step.h include/mlsmesh/core/$step.h src/core/$step.cpp; do
    [ -f "$file" ] || continue
    others=$(grep -oE "mlsmesh/(core/)?($steps)\.h" "$file" | sort -u | grep -vE "/(core/)?${step%_triangulation}(_triangulation)?\.h" || true)
    [ -z "$others" ] || fault "$file is a step and must not include another: $others"
  done
done

# Every "A includes B" between files of the project, as A B; tsort names the files of a cycle.
edges() {
  local file included
  find include src apps -name '*.h' -o -name '*.cpp' | while read -r file; do
    { grep -oE '^#include "[^"]+"' "$file" || true; } | cut -d'"' -f2 | while read -r included; do
      for folder in include apps src "$(dirname "$file")"; do
        if [ -f "$folder/$included" ]; then
          echo "$file $folder/$included"
          break
        fi
      done
    done
  done
}
cycles=$(edges | tsort 2>&1 > /dev/null || true)
[ -z "$cycles" ] || fault "headers include one another in a circle: $cycles"

[ "$faults" -eq 0 ] || exit 1
echo "check_includes: passed"

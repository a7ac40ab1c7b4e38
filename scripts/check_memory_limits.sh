#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_memory_limits.sh: runs mlsmesh_reconstruct on a scan of 200,000 points under limits of its address space
# (ulimit -v), from too little to start to enough. Each run must end with a mesh, or with exit code 1, one line that
# tells of memory, and no file. Limits at which even --version fails are the loader's and do not count. The programs
# are those of build/release, or of the preset that MLSMESH_PRESET names.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

bin=$root/build/${MLSMESH_PRESET:-release}/bin
for program in mlsmesh_sample mlsmesh_reconstruct; do
  [ -x "$bin/$program" ] || { echo "check_memory_limits: $bin/$program: not built; run scripts/setup.sh" >&2; exit 1; }
done
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$bin/mlsmesh_sample" figure "$work/cloud.pcd" --count 200000 --quiet

# limited KILOBYTES ARGUMENT...: the exit code of mlsmesh_reconstruct; what it prints goes to $work/err.
limited() {
  local kilobytes=$1 code=0
  shift
  (ulimit -c 0; ulimit -v "$kilobytes"; exec "$bin/mlsmesh_reconstruct" "$@") > /dev/null 2> "$work/err" || code=$?
  echo "$code"
}

refused=0 meshes=0
for arguments in "--levels 0" "--levels 2 --all-levels" "--no-reduction --levels 0"; do
  made=0
  for ((kilobytes = 40000; kilobytes <= 2000000 && made < 2; kilobytes += kilobytes < 120000 ? 2000 : 13000)); do
    [ "$(limited "$kilobytes" --version)" = 0 ] || continue
    # shellcheck disable=SC2086  # several words
    code=$(limited "$kilobytes" "$work/cloud.pcd" "$work/mesh.ply" --quiet $arguments)
    files=$(cd "$work" && echo *)
    if [ "$code" = 0 ] && [ -s "$work/mesh.ply" ]; then
      made=$((made + 1))
      rm -f "$work"/mesh*
    elif [ "$code" = 1 ] && [ "$(wc -l < "$work/err")" = 1 ] && grep -q memory "$work/err" && [ "$files" = "cloud.pcd err" ]; then
      refused=$((refused + 1))
    else
      echo "check_memory_limits: $arguments with $kilobytes kB: exit code $code, files: $files" >&2
      cat "$work/err" >&2
      exit 1
    fi
  done
  meshes=$((meshes + made))
done
[ "$meshes" = 6 ] && [ "$refused" -gt 10 ] || { echo "check_memory_limits: $meshes meshes, $refused refusals" >&2; exit 1; }
echo "check_memory_limits: $refused runs without enough memory said so, $meshes had enough"

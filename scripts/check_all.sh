#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What takes longer than .ci/run: both compilers with warnings as errors, the whole suite with both, the same bytes from both,
# clang-tidy, the whole suite under GCC's sanitizers, the fuzzers and the core's tests under clang's, the thread sanitizer, every
# cloud of the data, random scans of known surfaces, random clouds of all kinds, what happens without memory, whether PCL's viewer
# shows our meshes, whether the benchmarks run. Two hours on two cores; with names of parts, those alone.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

check_compilers() {
  local preset
  for preset in dev clang; do
    build_preset "$preset"
    ctest --test-dir "$root/build/$preset" --output-on-failure -j "$jobs"
  done
  "$root/scripts/check_determinism.sh" "$root/build/dev/bin" "$root/build/clang/bin"
}

check_tidy() {
  "$root/scripts/check_tidy.sh"
}

# Leaks are what libraries of the programs keep until the end; those of ours show in the tests of check_sanitized.sh.
check_asan() {
  build_preset asan
  ASAN_OPTIONS=detect_leaks=0 ctest --test-dir "$root/build/asan" --output-on-failure -j "$jobs"
}

check_sanitized() {
  "$root/scripts/check_sanitized.sh"
}

check_threads() {
  "$root/scripts/check_threads.sh"
}

check_clouds() {
  build_preset dev
  MLSMESH_PRESET=dev "$root/scripts/check_data.sh" --all
  MLSMESH_PRESET=dev "$root/scripts/check_random_scans.sh" 200
  "$root/build/dev/bin/mlsmesh_random_clouds" 10000
  "$root/build/dev/bin/mlsmesh_random_clouds" 100 1 100000
}

check_programs() {
  build_preset dev
  MLSMESH_PRESET=dev "$root/scripts/check_memory_limits.sh"
  "$root/scripts/check_pcl_viewer.sh" "$root/build/dev/bin"
  "$root/scripts/run_benchmarks.py" --quick --bin "$root/build/dev/bin" > /dev/null
}

parts=("$@")
[ $# -gt 0 ] || parts=(compilers tidy asan sanitized threads clouds programs)
for part in "${parts[@]}"; do
  if ! declare -F "check_$part" > /dev/null; then
    echo "check_all: $part: not a part; there are compilers, tidy, asan, sanitized, threads, clouds, programs" >&2
    exit 2
  fi
done
install_packages "$root/scripts/packages.txt" "$root/scripts/packages_check_all.txt" "$root/scripts/packages_sanitized.txt"
"$root/scripts/check_includes.sh"
for part in "${parts[@]}"; do
  echo "== $part"
  "check_$part"
done
echo "check_all: passed"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What takes longer than .ci/run: both compilers with warnings as errors, the whole suite with both, the core's tests
# under the sanitizers, every cloud of the data, random scans of known surfaces, random clouds of all kinds, whether PCL's
# viewer shows our meshes, whether the benchmarks run.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages "$root/scripts/packages.txt" "$root/scripts/packages_check_all.txt"
"$root/scripts/check_includes.sh"

for preset in dev clang; do
  echo "== $preset"
  build_preset "$preset"
  ctest --test-dir "$root/build/$preset" --output-on-failure -j "$jobs"
done

echo "== asan"
build_preset asan mlsmesh_core_tests mlsmesh_property_tests
for tests in mlsmesh_core_tests mlsmesh_property_tests; do
  "$root/build/asan/bin/$tests" --gtest_brief=1
done

echo "== data"
MLSMESH_PRESET=dev "$root/scripts/check_data.sh" --all

echo "== random scans"
MLSMESH_PRESET=dev "$root/scripts/check_random_scans.sh" 200

echo "== random clouds"
"$root/build/dev/bin/mlsmesh_random_clouds" 10000
"$root/build/dev/bin/mlsmesh_random_clouds" 100 1 100000

echo "== pcl_viewer"
"$root/scripts/check_pcl_viewer.sh" "$root/build/dev/bin"

echo "== benchmarks"
"$root/scripts/run_benchmarks.py" --quick --bin "$root/build/dev/bin" > /dev/null
echo "check_all: passed"

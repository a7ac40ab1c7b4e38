#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_sanitized.sh [--quick]: what the address and undefined-behaviour sanitizers of clang 14 see in the core's tests and in the
# fuzzers: two minutes of each fuzzer and all tests; --quick: five seconds of each, and without the tests of test/slow_tests.txt.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=120
filter='*'
if [ "${1:-}" = --quick ]; then
  seconds=5
  filter="-$(grep -v '^#' "$root/test/slow_tests.txt" | paste -sd:)"
fi
install_packages "$root/scripts/packages.txt" "$root/scripts/packages_sanitized.txt"
build_preset fuzz mlsmesh_core_tests fuzzers
tests=$root/build/fuzz/bin/mlsmesh_core_tests

# A pattern of the list that names no test would leave nothing out, unseen.
grep -v '^#' "$root/test/slow_tests.txt" | while read -r pattern; do
  "$tests" --gtest_list_tests "--gtest_filter=$pattern" | grep -q '^  ' \
    || { echo "check_sanitized: test/slow_tests.txt: $pattern: no such test" >&2; exit 1; }
done

log=$(mktemp -d)
trap 'rm -rf "$log"' EXIT
shards=()
for ((shard = 0; shard < jobs; ++shard)); do
  GTEST_TOTAL_SHARDS=$jobs GTEST_SHARD_INDEX=$shard OMP_NUM_THREADS=2 ASAN_OPTIONS=detect_leaks=1 \
    "$tests" --gtest_brief=1 "--gtest_filter=$filter" > "$log/$shard" 2>&1 &
  shards+=($!)
done
failed=false
for ((shard = 0; shard < jobs; ++shard)); do
  wait "${shards[$shard]}" || failed=true
  tail -n "$($failed && echo 200 || echo 2)" "$log/$shard"
done
if $failed; then
  echo "check_sanitized: tests failed" >&2
  exit 1
fi
"$root/scripts/run_fuzzers.sh" "$seconds"

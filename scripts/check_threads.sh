#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_threads.sh [GTEST_FILTER]: runs the core's tests under the thread sanitizer. The sanitizer learns from libarcher, which
# LLVM's OpenMP runtime loads, how loops wait for each other; that it does so, and that it still sees a race, is tried first on
# two small programs.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
OMP_TOOL_LIBRARIES=$(dirname "$(readlink -f "$(command -v clang++-14)")")/../lib/libarcher.so
export OMP_TOOL_LIBRARIES
export TSAN_OPTIONS="ignore_noninstrumented_modules=1 halt_on_error=1 exitcode=66 suppressions=$root/test/thread_sanitizer.supp"

# run_loop BODY: the exit code of a program that runs BODY in parallel and adds up what it left in `items`.
run_loop() {
  cat > "$work/loop.cpp" << EOF
#include <vector>
int main() {
  std::vector<int> items(1000);
  int sum = 0;
#pragma omp parallel for num_threads(4)
  for (int i = 0; i < 1000; ++i) { $1 }
  for (const int item : items) sum += item;
  return sum < 0;
}
EOF
  clang++-14 -g -fopenmp -fsanitize=thread "$work/loop.cpp" -o "$work/loop"
  local code=0
  "$work/loop" > "$work/loop.log" 2>&1 || code=$?
  echo "$code"
}

if [ "$(run_loop 'items[i] = i;')" -ne 0 ]; then
  echo "check_threads: the sanitizer reports a race where there is none; is $OMP_TOOL_LIBRARIES there?" >&2
  exit 1
fi
if [ "$(run_loop 'items[i] = i; sum += i;')" -ne 66 ]; then
  echo "check_threads: the sanitizer does not see a race" >&2
  exit 1
fi

build_preset tsan mlsmesh_core_tests
"$root/build/tsan/bin/mlsmesh_core_tests" --gtest_brief=1 "--gtest_filter=${1:-*}"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# run_fuzzers.sh SECONDS [NAME...]: builds the fuzzers and runs each (or those named) for so many seconds, one after the
# other, from the seeds of fuzz/corpus and from what earlier runs found (build/fuzz/corpus). Prints the executions of
# each, and fails if one found anything: what it found is then in build/fuzz/findings.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

seconds=${1:?usage: run_fuzzers.sh SECONDS [NAME...]}
shift
install_packages "$root/scripts/packages.txt" "$root/scripts/packages_sanitized.txt"
build_preset fuzz fuzzers
build=$root/build/fuzz
names=("$@")
[ "${#names[@]}" -gt 0 ] || mapfile -t names < "$build/fuzzers.txt"

# The file that every trial writes lies in memory, where there is such a folder.
TMPDIR=$(mktemp -d -p "$([ -w /dev/shm ] && echo /dev/shm || echo "${TMPDIR:-/tmp}")" mlsmesh-fuzz-XXXXXX)
export TMPDIR
trap 'rm -rf "$TMPDIR"' EXIT

# Inputs are 4 KB at most, so an allocation of 64 MB is a finding.
export OMP_NUM_THREADS=1
# VTK leaks a few bytes over damaged files.
export LSAN_OPTIONS=suppressions=$root/fuzz/leaks.txt:print_suppressions=0
failed=()
for name in "${names[@]}"; do
  corpus=$build/corpus/$name
  findings=$build/findings/$name
  log=$build/$name.log
  mkdir -p "$corpus" "$findings"
  seeds=()
  [ ! -d "$root/fuzz/corpus/$name" ] || seeds=("$root/fuzz/corpus/$name")
  dictionary=()
  [ ! -f "$root/fuzz/dictionaries/$name.txt" ] || dictionary=(-dict="$root/fuzz/dictionaries/$name.txt")
  if nice "$build/bin/fuzz_$name" -max_total_time="$seconds" -max_len=4096 -timeout=20 -rss_limit_mb=2048 \
    -malloc_limit_mb=64 -print_final_stats=1 -artifact_prefix="$findings/" "${dictionary[@]}" "$corpus" "${seeds[@]}" \
    > "$log" 2>&1; then
    result=passed
  else
    result="FAILED, see $log and $findings"
    failed+=("$name")
  fi
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "$name: ${executions:-?} executions, $result"
done
[ "${#failed[@]}" -eq 0 ] || { echo "run_fuzzers: findings of ${failed[*]}" >&2; exit 1; }

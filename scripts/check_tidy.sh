#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# check_tidy.sh [REGEX]: clang-tidy with the checks of .clang-tidy over the sources whose path matches (default: the library's,
# about 12 s of CPU each). Any finding fails; a false one is silenced where it stands, with the reason beside it.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

if [ ! -f "$root/build/clang/compile_commands.json" ]; then
  (cd "$root" && cmake --preset clang)
fi
log=$(mktemp)
trap 'rm -f "$log"' EXIT
run-clang-tidy-14 -quiet -j "$jobs" -p "$root/build/clang" -config-file "$root/.clang-tidy" "${1:-$root/src/}" > "$log" 2>&1 || true
if grep -E '(warning|error):' "$log" | sort -u | grep .; then
  echo "check_tidy: findings" >&2
  exit 1
fi
# Nothing found may also mean that nothing was looked at.
files=$(grep -c '^clang-tidy-14 ' "$log" || true)
[ "$files" -gt 0 ] || { cat "$log" >&2; echo "check_tidy: no source matches ${1:-$root/src/}" >&2; exit 1; }
echo "check_tidy: $files sources, no finding"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs the whole test suite on build/release, after the same set-up as the demo.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

"$root/scripts/setup.sh"
ctest --test-dir "$root/build/release" --output-on-failure -j "$jobs" "$@"

#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Makes build/release: installs the Debian packages that are missing, configures, builds. Says nothing new to a machine
# where all of it is done.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

install_packages "$root/scripts/packages.txt"
build_preset release

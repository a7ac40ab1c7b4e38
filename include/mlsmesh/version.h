// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#define MLSMESH_VERSION_MAJOR 0
#define MLSMESH_VERSION_MINOR 1
#define MLSMESH_VERSION_PATCH 0
#define MLSMESH_VERSION "0.1.0"

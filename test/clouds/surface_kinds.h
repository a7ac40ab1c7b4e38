// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clouds/random_clouds.h"

namespace mlsmesh::test {

/// Clouds that come from surfaces, clean and not.
std::vector<CloudKind> surfaceKinds();

/// Clouds that come from no surface.
std::vector<CloudKind> otherKinds();

}  // namespace mlsmesh::test

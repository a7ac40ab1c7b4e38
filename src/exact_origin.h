// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "mlsmesh/core/types.h"

namespace mlsmesh {

/// Positions moved near to the origin, along each axis where that takes no rounding (else not), so that exact
/// tests of them are fast.
std::vector<core::Vec3> movedNearOrigin(std::vector<core::Vec3> positions);

}  // namespace mlsmesh

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "mlsmesh/core/mls_reduction.h"

namespace mlsmesh::core {

struct DividedClusters {
  std::vector<char> divided;  ///< of the clusters before
  IndexLists clusters;        ///< those that are not divided, in their order, then the parts of the others
};

/// Divides clusters where another sheet is so near that a front over the representatives might cross to it:
/// their distance is to be small beside that of the sheets. None if there are no such. O(n).
std::optional<DividedClusters> clustersBetweenSheets(const std::vector<Vec3>& points,
                                                     const IndexLists& clusters,
                                                     const Representatives& representatives,
                                                     const Context& context);

}  // namespace mlsmesh::core

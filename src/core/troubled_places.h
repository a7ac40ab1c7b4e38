// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/advancing_front.h"

namespace mlsmesh::core {

/// Of `count` representatives, those that the triangulation had trouble with (Triangulation::troubled) and
/// those that share a triangle with one.
std::vector<char> aroundTrouble(const Triangulation& triangulation, Index count);

/// The clusters, but that the points of the marked ones are clustered anew, half as many to a cluster: these
/// come last. Every point is still in exactly one. O(m log m) for the m points of the marked ones. Throws
/// Failure(Cancelled).
IndexLists finerClusters(const std::vector<Vec3>& points, const IndexLists& clusters,
                         const std::vector<char>& marked, const ClusteringParameters& parameters,
                         const Context& context);

}  // namespace mlsmesh::core

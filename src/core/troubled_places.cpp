// SPDX-License-Identifier: BSD-3-Clause
// Related: N. Amenta, M. Bern, "Surface reconstruction by Voronoi filtering", 1999: a sample carries a
// surface where it is dense beside the distance to the medial axis. Where the mesh of the representatives
// meets itself, or a loop will not close, they are too sparse for how thin the surface is; the cloud is
// denser.
#include "troubled_places.h"

#include <algorithm>

#include "mlsmesh/core/bsp_clustering.h"

namespace mlsmesh::core {

std::vector<char> aroundTrouble(const Triangulation& triangulation, Index count) {
  const auto original = [&](Index v) { return v < count ? v : triangulation.duplicate_of[v - count]; };
  std::vector<char> troubled(static_cast<std::size_t>(count), 0);
  for (const Index v : triangulation.troubled) troubled[original(v)] = 1;
  std::vector<char> around = troubled;
  for (const Triangle& t : triangulation.triangles) {
    if (std::none_of(t.begin(), t.end(), [&](Index v) { return troubled[original(v)] != 0; })) continue;
    for (const Index v : t) around[original(v)] = 1;
  }
  return around;
}

IndexLists finerClusters(const std::vector<Vec3>& points, const IndexLists& clusters,
                         const std::vector<char>& marked, const ClusteringParameters& parameters,
                         const Context& context) {
  IndexLists finer;
  std::vector<Index> freed;
  for (Index c = 0; c < clusters.count(); ++c) {
    if (marked[c])
      freed.insert(freed.end(), clusters.data(c), clusters.data(c) + clusters.size(c));
    else
      finer.append(clusters.data(c), clusters.size(c));
  }
  if (freed.empty()) return finer;
  std::sort(freed.begin(), freed.end());
  std::vector<Vec3> positions;
  for (const Index p : freed) positions.push_back(points[p]);
  ClusteringParameters halved = parameters;
  halved.max_size = std::max(1, parameters.max_size / 2);
  halved.min_leaf = 1;
  const IndexLists parts = clusterPoints(positions, halved, context);
  for (Index part = 0; part < parts.count(); ++part) {
    std::vector<Index> members;
    for (Index i = 0; i < parts.size(part); ++i) members.push_back(freed[parts.data(part)[i]]);
    finer.append(members.data(), static_cast<Index>(members.size()));
  }
  return finer;
}

}  // namespace mlsmesh::core

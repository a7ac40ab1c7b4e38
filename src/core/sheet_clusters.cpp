// SPDX-License-Identifier: BSD-3-Clause
// Related: N. Amenta, M. Bern, "Surface reconstruction by Voronoi filtering", 1999: how dense a sample must
// be follows from the distance to the medial axis, which between two sheets is half of theirs.
#include "sheet_clusters.h"

#include <algorithm>

#include "mlsmesh/core/bsp_clustering.h"

namespace mlsmesh::core {
namespace {

// Points to a cluster whose representatives are to lie much nearer to each other than to the next sheet.
Index mostBeside(double sheet_gap, double spacing) {
  constexpr double kSteps = 1.5;  // between representatives, in the gap
  const double step = sheet_gap / (kSteps * spacing);
  return step * step < 1 ? 1 : static_cast<Index>(std::min(step * step, 1e6));
}

// The cluster's points, `most` to a part.
IndexLists divided(const std::vector<Vec3>& points, const Index* members, Index count, Index most,
                   const Context& context) {
  std::vector<Vec3> positions;
  for (Index i = 0; i < count; ++i) positions.push_back(points[members[i]]);
  ClusteringParameters parameters;
  parameters.max_size = most;
  parameters.max_variation = 1;
  parameters.min_leaf = 1;
  IndexLists parts = clusterPoints(positions, parameters, context);
  for (Index& i : parts.items) i = members[i];
  return parts;
}

}  // namespace

std::optional<DividedClusters> clustersBetweenSheets(const std::vector<Vec3>& points,
                                                     const IndexLists& clusters,
                                                     const Representatives& representatives,
                                                     const Context& context) {
  DividedClusters result;
  result.divided.assign(static_cast<std::size_t>(clusters.count()), 0);
  IndexLists parts;
  for (Index c = 0; c < clusters.count(); ++c) {
    const Index most = mostBeside(representatives.sheet_gap[c], representatives.spacing[c]);
    result.divided[c] = clusters.size(c) > most;
    if (!result.divided[c]) {
      result.clusters.append(clusters.data(c), clusters.size(c));
      continue;
    }
    const IndexLists own = divided(points, clusters.data(c), clusters.size(c), most, context);
    for (Index part = 0; part < own.count(); ++part) parts.append(own.data(part), own.size(part));
  }
  if (parts.count() == 0) return std::nullopt;
  for (Index part = 0; part < parts.count(); ++part)
    result.clusters.append(parts.data(part), parts.size(part));
  return result;
}

}  // namespace mlsmesh::core

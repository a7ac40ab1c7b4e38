// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/features.h"
#include "mlsmesh/core/mls_surface.h"
#include "mlsmesh/core/point_set.h"

namespace mlsmesh::core {

/// One point per cluster on the MLS surface, structs of arrays of equal length; where the points themselves
/// take their place, position, nearest and kind alone are filled.
struct Representatives {
  std::vector<Vec3> position;     ///< local, already rounded to the stored type
  std::vector<Vec3> normal;       ///< unit, sign arbitrary
  std::vector<double> variation;  ///< surface variation sigma of the cluster's surroundings
  std::vector<double> spacing;    ///< local spacing of the input there
  std::vector<double> sheet_gap;  ///< to the nearest other sheet, where the projection saw one; or infinite
  std::vector<Index> nearest;     ///< point of the set nearest to the representative
  std::vector<VertexKind> kind;
  std::vector<Index> crease;  ///< number of the crease vertex, or kNone; empty if there are none

  Index size() const { return static_cast<Index>(position.size()); }
};

/// Step 2: projects the centroid of every cluster (paper section 2.2). Representatives that coincide once
/// rounded are kept once (the first cluster's); `clusters` is changed accordingly: the members of a dropped
/// one join the kept one. With features, clusters near sharp edges are divided by side and projected on it,
/// the crease vertices come last, and representatives too near to one are dropped.
Representatives reducePoints(const PointSet& points, const MlsSurface& surface, IndexLists& clusters,
                             const ReductionParameters& parameters, const Context& context,
                             const Features& features = {});

/// Projects the clusters whose `which` is not 0 again, as reducePoints does without features; the others keep
/// their representatives.
void renewRepresentatives(const std::vector<char>& which, const PointSet& points, const MlsSurface& surface,
                          const ReductionParameters& parameters, const Context& context,
                          Representatives& representatives, IndexLists& clusters);

/// As reducePoints without features for the clusters `finer`, whose first ones, in their order, are those
/// that have a representative and are not `divided`: these keep it.
void reduceDivided(const std::vector<char>& divided, IndexLists finer, const PointSet& points,
                   const MlsSurface& surface, const ReductionParameters& parameters, const Context& context,
                   Representatives& representatives, IndexLists& clusters);

/// Drops the representatives whose `keep` is 0, with their clusters.
void dropRepresentatives(const std::vector<char>& keep, Representatives& representatives,
                         IndexLists& clusters);

/// Drops representatives nearer to another than half their mean distance to their 6 nearest (of a pair the
/// later one), which projection of noisy clusters has stacked. Their members join the cluster of the nearest
/// one kept.
void dropCrowded(Representatives& representatives, IndexLists& clusters, const Context& context);

}  // namespace mlsmesh::core

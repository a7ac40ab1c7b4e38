// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/point_set.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// A vertex on a sharp edge (two sides) or corner (three) of the surface.
struct CreaseVertex {
  Vec3 position;
  Vec3 normal;  ///< unit, between the sides, sign arbitrary
  int sides = 2;
  std::array<Vec3, 3> side_normal;  ///< unit, sign arbitrary; of the first `sides`
  double spacing = 0;               ///< local spacing of the cloud there
};

/// What is known of the sharp edges of a cloud. All is empty where it has none.
struct Features {
  std::vector<CreaseVertex> vertices;  ///< along the edges, about FeatureParameters::spacing apart
  std::vector<Index> vertex_of;        ///< of each point: the crease vertex whose cluster it joins, or kNone
  std::vector<char> zone;              ///< of each point: whether a sharp edge is near
  std::vector<Vec3> normal;  ///< of each point: unit, of its own side, sign arbitrary; zero far from the zone

  bool any() const { return !vertices.empty(); }
};

/// Looks for sharp edges in the neighbourhoods of the clusters, of whose surroundings the surface variation
/// is given. The cloud must be clean. Finds none where few of the places that look like one prove to be, or
/// among fewer than 100 points. Each vertex has at least one point in its cluster. One search and one fit a
/// cluster that is not flat, and some ten times as much for each point near places that are not smooth.
Features detectFeatures(const PointSet& points, const NeighborSearch& search, const IndexLists& clusters,
                        const std::vector<double>& variation, const FeatureParameters& parameters,
                        const Context& context);

/// Clusters in which no point near a sharp edge is together with points of another side, those of the crease
/// vertices last, in their order: every point is still in exactly one.
struct SidedClusters {
  IndexLists clusters;
  std::vector<Vec3> normal;  ///< of each cluster's side; zero away from sharp edges
  Index first_crease = 0;    ///< cluster of the first crease vertex
};

SidedClusters clustersBySide(const PointSet& points, const IndexLists& clusters, const Features& features);

}  // namespace mlsmesh::core

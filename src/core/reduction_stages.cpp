// SPDX-License-Identifier: BSD-3-Clause
#include "reduction_stages.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "mlsmesh/core/bsp_clustering.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/outliers.h"
#include "sheet_clusters.h"

namespace mlsmesh::core {
namespace {

IndexLists singletons(Index count) {
  IndexLists lists;
  lists.begin.resize(static_cast<std::size_t>(count) + 1);
  std::iota(lists.begin.begin(), lists.begin.end(), 0);
  lists.items.resize(static_cast<std::size_t>(count));
  std::iota(lists.items.begin(), lists.items.end(), 0);
  return lists;
}

// Clusters, smaller than asked where a small cloud would leave too few of them to carry a surface.
IndexLists clustersOf(const std::vector<Vec3>& points, const MultiresolutionParameters& parameters,
                      Context& context) {
  ClusteringParameters clustering = parameters.clustering;
  IndexLists clusters = clusterPoints(points, clustering, context);
  if (clusters.count() >= parameters.min_representatives) return clusters;
  while (clusters.count() < parameters.min_representatives && clustering.max_size > 1) {
    clustering.max_size = std::max(1, 2 * clustering.max_size / 3);
    clustering.min_leaf = std::min(clustering.min_leaf, std::max(1, clustering.max_size / 2));
    clusters = clusterPoints(points, clustering, context);
  }
  if (clusters.count() < parameters.min_representatives)
    clusters = singletons(static_cast<Index>(points.size()));
  context.warnings.push_back("few points: clusters were made smaller, which leaves " +
                             std::to_string(clusters.count()) + " representatives");
  return clusters;
}

// The input points themselves in the place of representatives.
Representatives unreduced(const PointSet& points) {
  const std::size_t count = static_cast<std::size_t>(points.size());
  Representatives all;
  all.position = points.position;
  all.nearest.resize(count);
  std::iota(all.nearest.begin(), all.nearest.end(), 0);
  all.kind.assign(count, VertexKind::InputPoint);
  return all;
}

// Asks for as many neighbours as the triangulation will.
std::vector<Index> dropOutliers(const Context& context, KnownNeighbors& neighbors, Reconstruction& result) {
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const NeighborTable& table =
      neighbors.of(result.representatives.position,
                   std::max(kOutlierNeighbors, parameters.triangulation.neighbors), context);
  return core::dropOutliers(parameters.outliers, table, result.representatives, result.clusters);
}

// Points that belong to no surface, as far as the representatives tell.
std::vector<Index> outliersOf(const Surroundings& cloud, const Context& context, KnownNeighbors& neighbors,
                              Reconstruction& result) {
  if (!result.noise.parameters.outliers.remove) return {};
  std::vector<Index> found = dropOutliers(context, neighbors, result);
  const std::vector<Index> stray =
      strayPoints(cloud.points.position, cloud.surface(), result.representatives, result.clusters, context);
  found.insert(found.end(), stray.begin(), stray.end());
  std::sort(found.begin(), found.end());
  return found;
}

// Goes on without the outliers: with new clusters where they are many, with the old ones where a few went.
void leaveOut(const std::vector<Index>& outliers, Context& context, Surroundings& cloud,
              Reconstruction& result) {
  constexpr double kMany = 0.01;      // of the points
  constexpr std::size_t kFewest = 3;  // points of a surface
  if (outliers.size() + kFewest > cloud.points.position.size()) {
    throw Failure(StatusCode::NoTriangles,
                  "the points are so scattered that all were taken for outliers; outliers.remove = "
                  "false keeps them");
  }
  const MultiresolutionParameters& parameters = result.noise.parameters;
  const bool many = static_cast<double>(outliers.size()) > kMany * cloud.points.size();
  std::vector<Vec3> positions;
  for (const Index p : outliers) positions.push_back(cloud.points.position[p]);
  removePoints(outliers, cloud.points);
  cloud.renewSearch();
  renewSurface(result.noise, cloud);
  if (many) {
    clusterAndReduce(cloud, context, result);
    return;
  }
  const std::vector<char> touched = forgetMembers(outliers, positions, parameters.projection.neighbors,
                                                  result.representatives, result.clusters);
  renewRepresentatives(touched, cloud.points, cloud.surface(), parameters.reduction, context,
                       result.representatives, result.clusters);
}

}  // namespace

void clusterAndReduce(const Surroundings& cloud, Context& context, Reconstruction& result) {
  const MultiresolutionParameters& parameters = result.noise.parameters;
  result.clusters = clustersOf(cloud.points.position, parameters, context);
  result.representatives =
      reducePoints(cloud.points, cloud.surface(), result.clusters, parameters.reduction, context);
}

void useThePoints(const Surroundings& cloud, Reconstruction& result) {
  result.clusters = singletons(cloud.points.size());
  result.representatives = unreduced(cloud.points);
}

void removeOutliers(Context& context, Surroundings& cloud, KnownNeighbors& neighbors,
                    Reconstruction& result) {
  constexpr int kRounds = 3;      // what one outlier hid, the next round sees,
  constexpr double kFew = 0.001;  // unless they are so few, of the points, that none hides another
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Index> outliers = outliersOf(cloud, context, neighbors, result);
    if (outliers.empty()) return;
    result.outliers += static_cast<Index>(outliers.size());
    const bool few = outliers.size() < kFew * static_cast<double>(cloud.points.size());
    leaveOut(outliers, context, cloud, result);
    if (few) return;
  }
  if (result.noise.parameters.outliers.remove) dropOutliers(context, neighbors, result);
}

void divideBetweenSheets(const Surroundings& cloud, const Context& context, Reconstruction& result) {
  std::optional<DividedClusters> finer =
      clustersBetweenSheets(cloud.points.position, result.clusters, result.representatives, context);
  if (!finer) return;
  reduceDivided(finer->divided, std::move(finer->clusters), cloud.points, cloud.surface(),
                result.noise.parameters.reduction, context, result.representatives, result.clusters);
}

void keepFeatures(const Surroundings& cloud, const Context& context, Reconstruction& result) {
  MultiresolutionParameters& parameters = result.noise.parameters;
  const FeatureParameters& features = parameters.features;
  if (!features.detect || result.noise.estimate.relative > features.max_noise) return;
  result.features = detectFeatures(cloud.points, cloud.search(), result.clusters,
                                   result.representatives.variation, features, context);
  if (!result.features.any()) return;
  result.representatives = reducePoints(cloud.points, cloud.surface(), result.clusters, parameters.reduction,
                                        context, result.features);
  parameters.refinement.threshold *= features.threshold_share;
}

}  // namespace mlsmesh::core

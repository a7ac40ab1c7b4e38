// SPDX-License-Identifier: BSD-3-Clause
// This work is based on S. Fleishman, D. Cohen-Or, C. T. Silva, "Robust moving least-squares fitting with
// sharp features", SIGGRAPH 2005, and M. Pauly, R. Keiser, M. Gross, "Multi-scale feature extraction on
// point-sampled surfaces", Eurographics 2003: places that are not smooth are told by a cheap measure first.
// Departure: the measure is the misfit of one quadric, which curvature alone does not raise, taken once a
// cluster.
#include "mlsmesh/core/features.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "crease_feet.h"
#include "crease_vertices.h"
#include "mlsmesh/core/parallel.h"
#include "surface_patch.h"

namespace mlsmesh::core {
namespace {

constexpr Index kLeastPoints = 100;
constexpr double kFlatCluster = 0.002;  // surface variation below which no edge is near
constexpr int kClusterNeighbors = 32;   // of the centroid, in the first test
constexpr double kRoughCluster = 0.03;  // misfit in local spacings above which its points are tested
constexpr double kFoldedCluster = 0.1;  // misfit in local spacings of a cluster that may hold an edge ...
constexpr double kFoldedShare = 0.4;    // ... if two planes leave no more than this share of it
constexpr double kConfirmed = 0.3;      // share of the points there that must prove to be at an edge
constexpr int kNeighbors = 25;          // of a point, itself included
constexpr double kRoughPoint = 0.03;    // misfit in local spacings above which a foot is looked for
constexpr int kZone = 17;               // nearest points that a foot's point brings into the zone
constexpr double kPi = 3.14159265358979323846;

// Misfits around the centroid of every `step`-th cluster, in local spacings; 0 where the surface is flat, and
// of the others.
std::vector<Misfit> clusterMisfits(const std::vector<Vec3>& points, const NeighborSearch& search,
                                   const IndexLists& clusters, const std::vector<double>& variation,
                                   std::size_t step, const Context& context) {
  std::vector<Misfit> misfit(static_cast<std::size_t>(clusters.count()));
  parallelBlocks(context, misfit.size(), 256, [&](std::size_t first, std::size_t last) {
    std::array<Index, kClusterNeighbors> nearest;
    std::array<double, kClusterNeighbors> squared_distance;
    for (std::size_t c = (first + step - 1) / step * step; c < last; c += step) {
      if (variation[c] < kFlatCluster) continue;
      const Index* members = clusters.data(static_cast<Index>(c));
      const Index size = clusters.size(static_cast<Index>(c));
      Vec3 sum = Vec3::Zero();
      for (Index i = 0; i < size; ++i) sum += points[members[i]] - points[members[0]];
      const int count = search.nearest(points[members[0]] + sum / size, kClusterNeighbors, nearest.data(),
                                       squared_distance.data());
      const double spacing = std::sqrt(squared_distance[static_cast<std::size_t>(count - 1)] / (count / kPi));
      misfit[c] = misfitOf(points, nearest.data(), count, kFoldedCluster * spacing);
      misfit[c].smooth /= spacing;
      misfit[c].folded /= spacing;
    }
  });
  return misfit;
}

bool isRough(const Misfit& misfit) {
  return misfit.smooth > kRoughCluster;
}

bool isFolded(const Misfit& misfit) {
  return misfit.smooth > kFoldedCluster && misfit.folded < kFoldedShare * misfit.smooth;
}

std::vector<Index> membersWhere(bool (*isWanted)(const Misfit&), const std::vector<Misfit>& misfit,
                                const IndexLists& clusters) {
  std::vector<Index> members;
  for (Index c = 0; c < clusters.count(); ++c) {
    if (!isWanted(misfit[c])) continue;
    members.insert(members.end(), clusters.data(c), clusters.data(c) + clusters.size(c));
  }
  return members;
}

struct RoughPoints {
  std::vector<Index> points;
  std::vector<double> residual;
};

RoughPoints roughAmong(const std::vector<Index>& candidates, const SparseNeighbors& neighbors,
                       const Context& context) {
  std::vector<double> residual(candidates.size());
  parallelBlocks(context, candidates.size(), 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      residual[i] = quadricResidual(neighbors.positions(), neighbors.row(candidates[i]), neighbors.k());
    }
  });
  RoughPoints rough;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (residual[i] <= kRoughPoint * neighbors.spacing(candidates[i])) continue;
    rough.points.push_back(candidates[i]);
    rough.residual.push_back(residual[i]);
  }
  return rough;
}

struct Creases {
  std::vector<Index> points;
  std::vector<CreaseFoot> feet;  // of each point
};

// The feet of those candidates whose surroundings are not smooth.
Creases feetOf(const std::vector<Index>& candidates, double cosine, SparseNeighbors& neighbors,
               RobustNormals& normals, const Context& context) {
  neighbors.add(candidates, context);
  RoughPoints rough = roughAmong(candidates, neighbors, context);
  normals.add(neighbors.grown(rough.points, kNeighbors), context);
  std::vector<CreaseFoot> feet(rough.points.size());
  parallelBlocks(context, feet.size(), 128, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      feet[i] = creaseFootOf(rough.points[i], rough.residual[i], cosine, neighbors, normals);
    }
  });
  return {std::move(rough.points), std::move(feet)};
}

// Whether the points of folded clusters, of a sample of all clusters, hold too few feet that are clearly
// sharp for enough of all to be kept, by a third: most clouds without sharp edges are left here.
bool areHopeless(const std::vector<Index>& sample, double cosine, SparseNeighbors& neighbors,
                 RobustNormals& normals, const Context& context) {
  constexpr std::size_t kLeast = 40;
  constexpr double kHopeless = 0.75 * kConfirmed * kSharpShare;
  if (sample.size() < kLeast) return false;
  const Creases tried = feetOf(sample, cosine, neighbors, normals, context);
  const auto sharp = std::count_if(tried.feet.begin(), tried.feet.end(), isClearlySharp);
  return static_cast<double>(sharp) < kHopeless * static_cast<double>(sample.size());
}

// The feet of those candidates that lie near a sharp edge.
Creases creasesAmong(const std::vector<Index>& candidates, double cosine, SparseNeighbors& neighbors,
                     RobustNormals& normals, const Context& context) {
  const Creases all = feetOf(candidates, cosine, neighbors, normals, context);
  const std::vector<char> kept = keptFeet(all.points, all.feet, neighbors);
  Creases creases;
  for (std::size_t i = 0; i < all.feet.size(); ++i) {
    if (!kept[i]) continue;
    creases.points.push_back(all.points[i]);
    creases.feet.push_back(all.feet[i]);
  }
  return creases;
}

}  // namespace

Features detectFeatures(const PointSet& set, const NeighborSearch& search, const IndexLists& clusters,
                        const std::vector<double>& variation, const FeatureParameters& parameters,
                        const Context& context) {
  Features features;
  const std::vector<Vec3>& points = set.position;
  if (!parameters.detect || set.size() < kLeastPoints) return features;
  SparseNeighbors neighbors(points, search, kNeighbors);
  RobustNormals normals(neighbors);
  const double cosine = std::cos(parameters.angle * kPi / 180);
  constexpr std::size_t kSampleStep = 6;
  const std::vector<Misfit> some = clusterMisfits(points, search, clusters, variation, kSampleStep, context);
  if (areHopeless(membersWhere(isFolded, some, clusters), cosine, neighbors, normals, context))
    return features;
  const std::vector<Misfit> misfit = clusterMisfits(points, search, clusters, variation, 1, context);
  const std::vector<Index> folded = membersWhere(isFolded, misfit, clusters);
  const Creases sure = creasesAmong(folded, cosine, neighbors, normals, context);
  if (sure.points.empty() || sure.points.size() < kConfirmed * folded.size()) return features;
  const Creases creases =
      creasesAmong(membersWhere(isRough, misfit, clusters), cosine, neighbors, normals, context);
  const std::vector<Index> zone = neighbors.grown(creases.points, kZone);
  features.zone.assign(points.size(), 0);
  for (const Index p : zone) features.zone[p] = 1;
  neighbors.add(zone, context);
  normals.add(neighbors.grown(zone, kNeighbors), context);
  chooseCreaseVertices(creases.points, creases.feet, points, search, normals, parameters.spacing, context,
                       features);
  features.normal = normals.all();
  return features;
}

}  // namespace mlsmesh::core

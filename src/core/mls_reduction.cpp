// SPDX-License-Identifier: BSD-3-Clause
// This work is based on B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution
// surface approximation", SIBGRAPI 2003, section 2.2. Departures: a cluster may bridge two parts of the
// surface, then its centroid lies off both and the projection starts from a member; and a projection that
// leaves its cluster is refused, because a degree-2 fit can throw a point twelve spacings away where two
// sheets are near.
#include "mlsmesh/core/mls_reduction.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

constexpr double kFarCentroid =
    0.7;  // local spacings between centroid and nearest member: start from the member
constexpr double kLeastReach = 0.3;  // local spacings that a projection may always move
constexpr double kSideCone = 0.75;   // cosine of the normals of points of one side
constexpr double kNearCrease = 0.9;  // local spacings within which a crease vertex stands for the place

struct ClusterShape {
  Vec3 centroid;
  double radius = 0;      // largest distance of a member from the centroid
  Index central = kNone;  // the member nearest to the centroid
  double off = 0;         // its distance
};

ClusterShape shapeOf(const std::vector<Vec3>& points, const Index* members, Index count) {
  ClusterShape shape;
  const Vec3 reference = points[members[0]];
  Vec3 sum = Vec3::Zero();
  for (Index i = 0; i < count; ++i) sum += points[members[i]] - reference;
  shape.centroid = reference + sum / count;
  shape.off = std::numeric_limits<double>::max();
  for (Index i = 0; i < count; ++i) {
    const double d = (points[members[i]] - shape.centroid).norm();
    shape.radius = std::max(shape.radius, d);
    if (d < shape.off) {
      shape.off = d;
      shape.central = members[i];
    }
  }
  return shape;
}

bool lands(const Projection& projection, const Vec3& start, double reach) {
  return projection.position.allFinite() && projection.normal.allFinite() &&
         (projection.position - start).norm() <= reach;
}

// One side of the surface near a sharp edge; the whole surface elsewhere (no normal).
struct Side {
  const MlsSurface& surface;
  const std::vector<Vec3>& normals;  // of the points
  Vec3 normal;

  bool isWhole() const { return normal.squaredNorm() == 0; }
  Projection project(const Vec3& x, int degree) const {
    return isWhole() ? surface.project(x, degree)
                     : surface.projectSide(x, degree, normal, normals, kSideCone);
  }
};

Projection inputPoint(const Side& side, Index point) {
  const Vec3& position = side.surface.points()[point];
  Projection projection = side.project(position, side.surface.parameters().degree);
  projection.position = position;
  projection.nearest = point;
  projection.kind = VertexKind::InputPoint;
  return projection;
}

Projection representativeOf(const Side& side, const ClusterShape& shape,
                            const ReductionParameters& parameters) {
  const MlsSurface& surface = side.surface;
  const int degree = surface.parameters().degree;
  const bool guarded = parameters.clamp == ClampRule::Guarded;
  const Vec3 first = side.isWhole() ? surface.startFrom(shape.centroid) : shape.centroid;
  Projection projection = side.project(first, degree);
  Vec3 start = shape.centroid;
  if (guarded && shape.off > kFarCentroid * projection.spacing) {
    start = surface.points()[shape.central];
    projection = side.project(start, degree);
  }
  const double reach = guarded ? std::max(0.5 * shape.radius, kLeastReach * projection.spacing)
                               : std::numeric_limits<double>::max();
  if (lands(projection, start, reach)) return projection;
  if (degree > 1) {
    projection = side.project(start, 1);
    if (lands(projection, start, reach)) return projection;
  }
  return inputPoint(side, shape.central);
}

Projection creaseRepresentative(const MlsSurface& surface, const CreaseVertex& vertex) {
  Projection projection = surface.project(vertex.position);
  projection.position = vertex.position;
  projection.normal = vertex.normal;
  projection.kind = VertexKind::Crease;
  return projection;
}

void store(const Projection& projection, const PointSet& points, std::size_t i, Representatives& all) {
  all.position[i] = points.stored(projection.position);
  all.normal[i] = projection.normal;
  all.variation[i] = projection.variation;
  all.spacing[i] = projection.spacing;
  all.sheet_gap[i] = projection.sheet_gap;
  all.nearest[i] = projection.nearest;
  all.kind[i] = projection.kind;
}

// Equal positions, first cluster of each group -> kNone, the others -> the first.
std::vector<Index> coincident(const std::vector<Vec3>& position, const Context& context) {
  CancelCheck check(context);
  std::vector<Index> order(position.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    check();
    const auto& p = position[a];
    const auto& q = position[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3) || (p == q && a < b);
  });
  std::vector<Index> same_as(position.size(), kNone);
  for (std::size_t i = 1; i < order.size(); ++i) {
    const Index previous = order[i - 1];
    if (position[order[i]] == position[previous]) {
      same_as[order[i]] = same_as[previous] == kNone ? previous : same_as[previous];
    }
  }
  return same_as;
}

template <typename T>
void keepOnly(const std::vector<Index>& kept, std::vector<T>& values) {
  for (std::size_t i = 0; i < kept.size(); ++i) values[i] = values[kept[i]];
  values.resize(kept.size());
}

IndexLists mergeClusters(const IndexLists& clusters, const std::vector<Index>& same_as,
                         const Context& context) {
  CancelCheck check(context);
  std::vector<std::vector<Index>> extra(clusters.count());
  for (Index i = 0; i < clusters.count(); ++i) {
    check();
    if (same_as[i] == kNone) continue;
    auto& list = extra[same_as[i]];
    list.insert(list.end(), clusters.data(i), clusters.data(i) + clusters.size(i));
  }
  IndexLists merged;
  for (Index i = 0; i < clusters.count(); ++i) {
    check();
    if (same_as[i] != kNone) continue;
    const auto from = merged.items.size();
    merged.items.insert(merged.items.end(), clusters.data(i), clusters.data(i) + clusters.size(i));
    merged.items.insert(merged.items.end(), extra[i].begin(), extra[i].end());
    std::sort(merged.items.begin() + static_cast<std::ptrdiff_t>(from), merged.items.end());
    merged.begin.push_back(static_cast<Index>(merged.items.size()));
  }
  return merged;
}

void keepOnly(const std::vector<Index>& kept, Representatives& representatives) {
  keepOnly(kept, representatives.position);
  keepOnly(kept, representatives.normal);
  keepOnly(kept, representatives.variation);
  keepOnly(kept, representatives.spacing);
  keepOnly(kept, representatives.sheet_gap);
  keepOnly(kept, representatives.nearest);
  keepOnly(kept, representatives.kind);
  if (!representatives.crease.empty()) keepOnly(kept, representatives.crease);
}

// Drops every representative i with joins[i] != kNone; its members join that one, which is kept.
void dropJoined(const std::vector<Index>& joins, const Context& context, Representatives& representatives,
                IndexLists& clusters) {
  context.checkCancelled();
  std::vector<Index> kept;
  for (Index i = 0; i < representatives.size(); ++i) {
    if (joins[i] == kNone) kept.push_back(i);
  }
  if (static_cast<Index>(kept.size()) == representatives.size()) return;
  keepOnly(kept, representatives);
  clusters = mergeClusters(clusters, joins, context);
}

// The crease vertex that stands for each representative near it, or kNone.
std::vector<Index> nearCreases(const Representatives& representatives, Index first_crease,
                               const Context& context) {
  CancelCheck check(context);
  const std::vector<Vec3> crease(representatives.position.begin() + first_crease,
                                 representatives.position.end());
  const auto search = makeKdTree(crease, context);
  std::vector<Index> same_as(representatives.position.size(), kNone);
  for (Index i = 0; i < first_crease; ++i) {
    check();
    Index nearest = kNone;
    double squared_distance = 0;
    search->nearest(representatives.position[i], 1, &nearest, &squared_distance);
    const double reach = kNearCrease * representatives.spacing[i];
    if (squared_distance < reach * reach) same_as[i] = first_crease + nearest;
  }
  return same_as;
}

void numberCreases(Index first_crease, Representatives& representatives) {
  representatives.crease.assign(representatives.position.size(), kNone);
  std::iota(representatives.crease.begin() + first_crease, representatives.crease.end(), 0);
}

void resize(std::size_t count, Representatives& all) {
  all.position.resize(count);
  all.normal.resize(count);
  all.variation.resize(count);
  all.spacing.resize(count);
  all.sheet_gap.resize(count);
  all.nearest.resize(count);
  all.kind.resize(count);
}

// Projects the clusters whose `which` is not 0 as they are.
void projectAgain(const std::vector<char>& which, const PointSet& points, const MlsSurface& surface,
                  const ReductionParameters& parameters, const Context& context,
                  Representatives& representatives, const IndexLists& clusters) {
  const std::vector<Vec3> none;
  parallelBlocks(context, which.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!which[i]) continue;
      const Index cluster = static_cast<Index>(i);
      const ClusterShape shape = shapeOf(points.position, clusters.data(cluster), clusters.size(cluster));
      store(representativeOf({surface, none, Vec3::Zero()}, shape, parameters), points, i, representatives);
    }
  });
}

}  // namespace

Representatives reducePoints(const PointSet& points, const MlsSurface& surface, IndexLists& clusters,
                             const ReductionParameters& parameters, const Context& context,
                             const Features& features) {
  SidedClusters sided;
  sided.first_crease = clusters.count();
  if (features.any()) {
    sided = clustersBySide(points, clusters, features);
    clusters = std::move(sided.clusters);
  }
  const std::size_t count = static_cast<std::size_t>(clusters.count());
  Representatives result;
  resize(count, result);
  const auto make = [&](Index cluster) {
    if (cluster >= sided.first_crease) {
      return creaseRepresentative(surface, features.vertices[cluster - sided.first_crease]);
    }
    const ClusterShape shape = shapeOf(points.position, clusters.data(cluster), clusters.size(cluster));
    const Vec3 normal = features.any() ? sided.normal[cluster] : Vec3(Vec3::Zero());
    return representativeOf({surface, features.normal, normal}, shape, parameters);
  };
  parallelBlocks(context, count, 256, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      store(make(static_cast<Index>(i)), points, i, result);
    }
  });
  if (features.any()) {
    numberCreases(sided.first_crease, result);
    dropJoined(nearCreases(result, sided.first_crease, context), context, result, clusters);
  }
  dropJoined(coincident(result.position, context), context, result, clusters);
  return result;
}

void renewRepresentatives(const std::vector<char>& which, const PointSet& points, const MlsSurface& surface,
                          const ReductionParameters& parameters, const Context& context,
                          Representatives& representatives, IndexLists& clusters) {
  projectAgain(which, points, surface, parameters, context, representatives, clusters);
  dropJoined(coincident(representatives.position, context), context, representatives, clusters);
}

void reduceDivided(const std::vector<char>& divided, IndexLists finer, const PointSet& points,
                   const MlsSurface& surface, const ReductionParameters& parameters, const Context& context,
                   Representatives& representatives, IndexLists& clusters) {
  std::vector<Index> kept;
  for (Index i = 0; i < representatives.size(); ++i) {
    if (!divided[i]) kept.push_back(i);
  }
  keepOnly(kept, representatives);
  resize(static_cast<std::size_t>(finer.count()), representatives);
  std::vector<char> which(static_cast<std::size_t>(finer.count()), 1);
  std::fill_n(which.begin(), kept.size(), 0);
  clusters = std::move(finer);
  renewRepresentatives(which, points, surface, parameters, context, representatives, clusters);
}

void dropRepresentatives(const std::vector<char>& keep, Representatives& representatives,
                         IndexLists& clusters) {
  std::vector<Index> kept;
  IndexLists remaining;
  for (Index i = 0; i < representatives.size(); ++i) {
    if (!keep[i]) continue;
    kept.push_back(i);
    remaining.append(clusters.data(i), clusters.size(i));
  }
  keepOnly(kept, representatives);
  clusters = std::move(remaining);
}

void dropCrowded(Representatives& representatives, IndexLists& clusters, const Context& context) {
  constexpr int kNeighbors = 6;
  constexpr double kCrowded = 0.5;
  const std::vector<Vec3>& position = representatives.position;
  const auto search = makeKdTree(position, context);
  const NeighborTable neighbors = nearestOfAll(position, *search, kNeighbors, context);
  const std::vector<double> spacing = localSpacings(position, neighbors, context);
  std::vector<Index> joins(position.size(), kNone);
  for (Index i = 0; i < representatives.size(); ++i) {
    for (int j = 0; j < neighbors.k; ++j) {
      const Index other = neighbors.row(i)[j];
      const bool kept_before = other < i && joins[other] == kNone;
      if (!kept_before || (position[i] - position[other]).norm() >= kCrowded * spacing[i]) continue;
      joins[i] = other;
      break;
    }
  }
  dropJoined(joins, context, representatives, clusters);
}

}  // namespace mlsmesh::core

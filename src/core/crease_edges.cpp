// SPDX-License-Identifier: BSD-3-Clause
// This work is based on S. Fleishman, D. Cohen-Or, C. T. Silva, "Robust moving least-squares fitting with
// sharp features", SIGGRAPH 2005: near a sharp edge the surface of one side is fitted from the points of that
// side, and on the edge from both.
#include "crease_edges.h"

#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr int kSearched = 40;       // points nearest to a midpoint
constexpr int kSpacingPoints = 20;  // of those, that its local spacing is taken from
constexpr double kSideCone = 0.75;  // cosine of the normals of points of one side
constexpr double kBent = 0.94;      // cosine between the triangles of an edge along a sharp one
constexpr double kMayMove = 0.35;   // of the edge's length
constexpr double kPi = 3.14159265358979323846;

}  // namespace

bool CreaseEdges::isInZone(Index vertex) const {
  return isOnCrease(vertex) || features_.zone[refined_.nearest[vertex]];
}

bool CreaseEdges::isOnCrease(Index vertex) const {
  return refined_.kind[vertex] == VertexKind::Crease;
}

Vec3 CreaseEdges::normalOf(Index half_edge) const {
  const std::vector<Vec3>& x = refined_.position;
  return unitNormal(x[mesh_.origin(half_edge)], x[mesh_.target(half_edge)], x[mesh_.opposite(half_edge)]);
}

bool CreaseEdges::isNear(Index half_edge) const {
  return features_.any() && !mesh_.isBorder(half_edge) &&
         (isInZone(mesh_.origin(half_edge)) || isInZone(mesh_.target(half_edge)));
}

bool CreaseEdges::isAlong(Index half_edge) const {
  return isOnCrease(mesh_.origin(half_edge)) && isOnCrease(mesh_.target(half_edge)) &&
         normalOf(half_edge).dot(normalOf(mesh_.twin(half_edge))) < kBent;
}

Vec3 CreaseEdges::meanNormal(Index half_edge) const {
  const Vec3 sum = normalOf(half_edge) + normalOf(mesh_.twin(half_edge));
  const double length = sum.norm();
  return length > 1e-6 ? Vec3(sum / length) : Vec3(Vec3::Zero());
}

Projection CreaseEdges::onSide(const Vec3& middle, const Vec3& normal) const {
  return surface_.projectSide(middle, surface_.parameters().degree, normal, features_.normal, kSideCone);
}

bool CreaseEdges::onCrease(Index half_edge, Projection& projection) const {
  const Vec3 &u = refined_.position[mesh_.origin(half_edge)], &v = refined_.position[mesh_.target(half_edge)];
  const Vec3 middle = 0.5 * (u + v);
  std::array<Index, kSearched> nearest;
  std::array<double, kSearched> squared_distance;
  const int count = surface_.search().nearest(middle, kSearched, nearest.data(), squared_distance.data());
  const int last = std::min(count, kSpacingPoints);
  projection.spacing = std::sqrt(squared_distance[static_cast<std::size_t>(last - 1)] / (last / kPi));
  const CreaseFoot foot =
      footBetween(middle, {normalOf(half_edge), normalOf(mesh_.twin(half_edge)), Vec3::Zero()}, 2,
                  projection.spacing, nearest.data(), count, surface_.points(), features_.normal);
  if (foot.sides == 0) return false;
  const Vec3 along = (v - u).normalized();
  Vec3 step = foot.position - middle;
  step -= step.dot(along) * along;
  if (!(step.norm() < kMayMove * (v - u).norm())) return false;
  projection.position = middle + step;
  projection.normal = foot.bisector;
  projection.nearest = nearest[0];
  projection.kind = VertexKind::Crease;
  return true;
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution surface approximation",
//   SIBGRAPI 2003, section 2.3 (GET_POINT), which is one parameter set of these rules.
// - D. Cohen-Steiner, F. Da, "A greedy Delaunay-based surface reconstruction algorithm", 2004: order by
// radius and bend. Departures (defaults): the narrowest window first picks far coplanar points before near
// bent ones, so windows are wide and the bend is a penalty; edges are limited by the local spacing, because a
// multiple of the nearest distance stops at every pair of near-duplicates.
#include "front_rules.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
constexpr double kSliver =
    1e-6;  // twice the area over the squared longest edge, below which a triangle is none

double angleAt(const Vec3& apex, const Vec3& a, const Vec3& b) {
  return std::atan2((a - apex).cross(b - apex).norm(), (a - apex).dot(b - apex));
}

double degreesBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

double circumradius(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (a - b).norm() * (b - c).norm() * (c - a).norm() / (2 * (b - a).cross(c - a).norm());
}

}  // namespace

double FrontRules::lengthLimit(Index u, Index v) const {
  if (parameters_.length_rule == LengthRule::LocalSpacing) {
    return parameters_.length_factor * std::max(input_.spacing[u], input_.spacing[v]);
  }
  const auto nearest = [&](Index p) {
    return (input_.points[input_.neighbors.row(p)[0]] - input_.points[p]).norm();
  };
  return parameters_.length_factor * std::min(nearest(u), nearest(v));
}

int FrontRules::windowOf(double bend) const {
  if (bend > parameters_.bend_max) return -1;
  if (bend <= parameters_.bend_first) return 0;
  constexpr double kMost = 1e9;  // windows that an int can tell apart
  return static_cast<int>(
      std::min(kMost, std::ceil((bend - parameters_.bend_first) / parameters_.bend_step)));
}

double FrontRules::scoreOf(Index u, Index v, Index apex, double bend) const {
  const auto& p = input_.points;
  if (parameters_.apex_choice == ApexChoice::LargestAngle) return -angleAt(p[apex], p[u], p[v]);
  const double ls = std::max(input_.spacing[u], input_.spacing[v]);
  return circumradius(p[u], p[v], p[apex]) / ls * (1 + (bend / 45) * (bend / 45));
}

bool FrontRules::Candidate::operator<(const Candidate& other) const {
  if (window != other.window) return window < other.window;
  return score < other.score || (score == other.score && apex < other.apex);
}

void FrontRules::addCandidates(Index half_edge, const Index* row) const {
  const auto& p = input_.points;
  const Index u = mesh_.origin(half_edge);
  const Index v = mesh_.target(half_edge);
  const Index s = mesh_.opposite(half_edge);
  const double limit = lengthLimit(u, v);
  const Vec3 edge = p[u] - p[v];
  const double length = edge.norm();
  const Vec3 normal = unitNormal(p[u], p[v], p[s]);
  for (int i = 0; i < input_.neighbors.k; ++i) {
    const Index t = row[i];
    if (t == u || t == v || t == s || isInterior(t)) continue;
    const double longest = std::sqrt(std::max((p[t] - p[u]).squaredNorm(), (p[t] - p[v]).squaredNorm()));
    if (longest > limit || mesh_.find(u, t) != kNone || mesh_.find(t, v) != kNone) continue;
    const Vec3 area = edge.cross(p[t] - p[v]);
    const double widest = std::max(longest, length);
    if (area.norm() <= kSliver * widest * widest) continue;
    const double bend = degreesBetween(normal, area.normalized());
    const int window = windowOf(bend);
    if (window >= 0) candidates_.push_back({t, window, scoreOf(u, v, t, bend)});
  }
}

// In no particular order; those near both ends twice.
const std::vector<FrontRules::Candidate>& FrontRules::candidatesFor(Index half_edge) const {
  candidates_.clear();
  addCandidates(half_edge, input_.neighbors.row(mesh_.origin(half_edge)));
  if (parameters_.candidates == CandidateRule::BothEndpoints) {
    addCandidates(half_edge, input_.neighbors.row(mesh_.target(half_edge)));
  }
  return candidates_;
}

Apex FrontRules::likeliest(Index half_edge) const {
  const std::vector<Candidate>& candidates = candidatesFor(half_edge);
  if (candidates.empty()) return {};
  const Candidate& first = *std::min_element(candidates.begin(), candidates.end());
  return {first.apex, first.score};
}

Apex FrontRules::best(Index half_edge) const {
  candidatesFor(half_edge);
  std::sort(candidates_.begin(), candidates_.end());
  Index previous = kNone;
  for (const Candidate& candidate : candidates_) {
    if (candidate.apex == previous) continue;
    previous = candidate.apex;
    if (fits(mesh_.origin(half_edge), mesh_.target(half_edge), candidate.apex)) {
      return {candidate.apex, candidate.score};
    }
  }
  return {};
}

bool FrontRules::isLegal(Index half_edge, Index apex) const {
  const Index u = mesh_.origin(half_edge);
  const Index v = mesh_.target(half_edge);
  return mesh_.canAdd(v, u, apex) && !isInterior(apex) && fits(u, v, apex);
}

bool FrontRules::fits(Index u, Index v, Index apex) const {
  return !overlaps(u, v, apex) && input_.support.supports({v, u, apex});
}

void FrontRules::added(const Triangle& triangle) {
  for (const Index v : triangle) place_[v] = Place::Unknown;
}

bool FrontRules::isInterior(Index vertex) const {
  Place& place = place_[vertex];
  if (place == Place::Unknown) place = mesh_.isInterior(vertex) ? Place::Interior : Place::Elsewhere;
  return place == Place::Interior;
}

bool FrontRules::overlaps(Index u, Index v, Index apex) const {
  const auto& p = input_.points;
  const double longest = std::max({(p[u] - p[v]).norm(), (p[v] - p[apex]).norm(), (p[apex] - p[u]).norm()});
  const NewTriangle triangle{{v, u, apex}, unitNormal(p[v], p[u], p[apex]), longest};
  if (overlapsSector(mesh_, p, triangle, 2)) return true;
  if (parameters_.overlap_test == OverlapTest::ApexStar) return false;
  if (overlapsSector(mesh_, p, triangle, 0) || overlapsSector(mesh_, p, triangle, 1)) return true;
  const BorderCrossings crossings(mesh_, p, triangle);
  const std::vector<Index>& near = obstaclesNear(triangle.corner);
  return std::any_of(near.begin(), near.end(), [&](Index q) {
    return containsPoint(mesh_, p, triangle, q) || (mesh_.isUsed(q) && crossings.at(q, near));
  });
}

// The neighbours of the corners, each once, that the mesh does not go on around.
const std::vector<Index>& FrontRules::obstaclesNear(const Triangle& corners) const {
  std::vector<Index>& near = obstacles_;
  near.clear();
  for (const Index corner : corners) {
    const Index* row = input_.neighbors.row(corner);
    std::copy_if(row, row + input_.neighbors.k, std::back_inserter(near),
                 [&](Index q) { return !isInterior(q); });
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

}  // namespace mlsmesh::core

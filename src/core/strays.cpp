// SPDX-License-Identifier: BSD-3-Clause
// Related: S. Fleishman, D. Cohen-Or, C. T. Silva, "Robust moving least-squares fitting with sharp features",
// SIGGRAPH 2005: a fit is judged, and made again, without the points that it misses most.
#include <algorithm>
#include <cmath>

#include "height_fit.h"
#include "mlsmesh/core/outliers.h"
#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

constexpr int kLeastNeighbors = 12;

// Whether point number `point` lies farther from the surface below it, fitted without it and without the
// neighbours that it misses most, than `distance` local spacings and six times the median residual of that
// fit, with no more than two points nearer to it than that surface. Never with fewer than 12 neighbours. Two
// searches and three fits; one of each where it is near: a first plane leads from the point to the place on
// the surface below it; what counts is the distance from the surface fitted there.
bool isStray(const MlsSurface& surface, Index point, double distance) {
  constexpr double kResiduals = 6;  // median residuals of the neighbours
  constexpr double kSupport =
      3;  // local spacings: weights nearly even, so that strays do not vouch for each other
  constexpr double kClear = 0.5;  // share of the distance that even a plane bent by strays leaves
  constexpr int kCompany = 2;     // points nearer than the surface: other strays; more are a part of it
  const std::vector<Vec3>& points = surface.points();
  const int wanted = surface.parameters().neighbors;
  const Vec3& x = points[point];
  Neighborhood around;
  const auto isOther = [&](int i) { return around.index[i] != point; };
  around.find(surface.search(), x, wanted);
  around.keepIf(isOther);
  if (around.count < kLeastNeighbors) return false;
  Fit fit;
  double support = kSupport * around.localSpacing();
  around.weigh(points, x, support);
  fitInOneStep(points, x, 1, support, around, fit);
  if (std::abs(fit.height.g[0]) * kSupport < kClear * distance) return false;
  const Vec3 foot = x + fit.height.g[0] * support * fit.frame.normal();
  const Neighborhood around_point = around;

  around.find(surface.search(), foot, wanted);
  around.keepIf(isOther);
  if (around.count == 0) return false;  // the foot is nowhere, as the plane was none
  const double spacing = around.localSpacing();
  support = kSupport * spacing;
  around.weigh(points, foot, support);
  fitInOneStep(points, foot, 1, support, around, fit);
  const double limit = kResiduals * medianResidual(points, fit, support, around);
  around.keepIf([&](int i) { return std::abs(miss(points, fit, support, around, i)) <= limit; });
  if (around.count == 0) return false;
  fitInOneStep(points, foot, std::min(2, surface.parameters().degree), support, around, fit);
  const double offset = std::abs((x - foot).dot(fit.frame.normal()) - fit.height.g[0] * support);
  const auto* const distances = around_point.squared_distance.data();
  const auto nearer = std::count_if(distances, distances + around_point.count,
                                    [&](double squared) { return squared < offset * offset; });
  return offset > distance * spacing && nearer <= kCompany &&
         offset > kResiduals * medianResidual(points, fit, support, around);
}

// How far a member of a cluster must be from the plane of its representative to be suspect, the cheap test
// before the fit. A plane that strays have turned, or that was refused, tells nothing.
double suspectOffset(const Representatives& all, Index cluster) {
  constexpr double kSuspect = 0.5;  // local spacings
  constexpr double kUneven = 0.05;  // surface variation
  const bool vague = all.kind[cluster] == VertexKind::InputPoint || all.variation[cluster] > kUneven;
  return vague ? 0.0 : kSuspect * all.spacing[cluster];
}

}  // namespace

std::vector<Index> strayPoints(const std::vector<Vec3>& points, const MlsSurface& surface,
                               const Representatives& representatives, const IndexLists& clusters,
                               const Context& context) {
  constexpr double kStray = 0.75;  // local spacings off the surface of the neighbours
  std::vector<char> stray(points.size(), 0);
  parallelBlocks(
      context, static_cast<std::size_t>(clusters.count()), 512, [&](std::size_t first, std::size_t last) {
        for (Index c = static_cast<Index>(first); c < static_cast<Index>(last); ++c) {
          const double limit = suspectOffset(representatives, c);
          for (const Index* p = clusters.data(c); p != clusters.data(c) + clusters.size(c); ++p) {
            const double off = (points[*p] - representatives.position[c]).dot(representatives.normal[c]);
            stray[*p] = std::abs(off) >= limit && isStray(surface, *p, kStray);
          }
        }
      });
  std::vector<Index> found;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (stray[p]) found.push_back(static_cast<Index>(p));
  }
  return found;
}

}  // namespace mlsmesh::core

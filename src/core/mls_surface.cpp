// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - D. Levin, "Mesh-independent surface interpolation", 2003: the projection onto a moving-least-squares
// surface.
// - M. Alexa, J. Behr, D. Cohen-Or, S. Fleishman, D. Levin, C. T. Silva, "Computing and rendering point set
// surfaces",
//   TVCG 2003: its computation by a local reference plane and a bivariate polynomial.
// - B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution surface approximation",
//   SIBGRAPI 2003, section 2.2.
// Departures: the default takes the reference plane of the weighted points at x in one step (three times
// faster, and its fixed points are as accurate), and h follows the local spacing, because the paper's 3 d_1
// varies eight-fold on a uniform scan (d_1 is the distance of an arbitrary position to one point).
#include "mlsmesh/core/mls_surface.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "height_fit.h"
#include "near_sheets.h"

namespace mlsmesh::core {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLeastSupport =
    1.5;  // local spacings, under which the residual test never shrinks a support
constexpr double kSupportStep = 1.07;  // a support this near to the least one is left alone
constexpr double kSupportShrink = 0.75;
constexpr int kLeastNeighbors = 12;

// Levin's minimisation: the plane of the points weighted at q, and q as the foot of x on it, in turn to a
// fixed point.
Frame alternatingFrame(const std::vector<Vec3>& points, const Vec3& x, double spacing, double support,
                       const ProjectionParameters& parameters, Neighborhood& around, Vec3& foot) {
  Frame frame = principalFrame(points, x, around);
  foot = x;
  for (int round = 0; round < parameters.max_iterations; ++round) {
    const Vec3 moved = x - (x - frame.centroid).dot(frame.normal()) * frame.normal();
    const bool settled = (moved - foot).norm() <= parameters.tolerance * spacing;
    foot = moved;
    around.weigh(points, foot, support);
    if (settled) break;
    frame = principalFrame(points, x, around);
  }
  return frame;
}

// Of a place without neighbours: none.
Projection noProjection() {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  Projection none;
  none.position = none.normal = none.mean_difference = Vec3::Constant(kNaN);
  none.nearest = 0;
  return none;
}

// Forgets the neighbours beyond `distance`, but for the nearest ones that a quadric needs.
void truncate(double distance, Neighborhood& around) {
  while (around.count > kLeastNeighbors && around.squared_distance[around.count - 1] > distance * distance) {
    --around.count;
  }
}

// Whether points that a fit misses so may be those of several sheets. The first test costs nothing.
bool mayMixSheets(double variation, const ProjectionParameters& parameters) {
  constexpr double kMixed = 0.02;
  return variation >= kMixed && parameters.method == ProjectionMethod::OneStep;
}

bool mayMixSheets(double residual, double least, double residual_limit) {
  return residual > std::max(least, 2 * residual_limit);
}

// Makes the neighbours of x those on the sheet of the nearest one; none, and they stay, where no other is
// told from it.
std::optional<Slab> findSheet(const std::vector<Vec3>& points, const NeighborSearch& search, const Vec3& x,
                              double spacing, const ProjectionParameters& parameters, Neighborhood& around) {
  constexpr double kAir = 1.5;  // local spacings between sheets
  const std::optional<Slab> slab = sheetOfFirst(points, around.index.data(), around.count, kAir * spacing);
  if (!slab) return slab;
  around.find(search, x, 2 * parameters.neighbors);
  around.keepIf([&](int i) { return slab->contains(points[around.index[i]]); }, parameters.neighbors);
  return slab;
}

// Psi(x) from the neighbours given; their local spacing may be that of more points.
Projection fitProjection(const std::vector<Vec3>& points, const ProjectionParameters& parameters,
                         double residual_limit, const Vec3& x, int degree, double spacing,
                         Neighborhood& around, Fit& fit) {
  Projection result;
  result.spacing = spacing;
  result.support = around.supportRadius(result.spacing, parameters);
  result.mean_difference = around.meanDifference(points, x);

  around.weigh(points, x, result.support);
  if (parameters.method == ProjectionMethod::Levin) {
    fit.frame = alternatingFrame(points, x, result.spacing, result.support, parameters, around, fit.foot);
    fitWithFallback(points, degree, result.support, around, fit);
  } else {
    fitInOneStep(points, x, degree, result.support, around, fit);
    while (residual_limit > 0 && result.support > kLeastSupport * kSupportStep * result.spacing &&
           rmsResidual(points, fit, result.support, around) > residual_limit) {
      result.support = std::max(kLeastSupport * result.spacing, kSupportShrink * result.support);
      truncate(2 * result.support, around);
      around.weigh(points, x, result.support);
      fitInOneStep(points, x, degree, result.support, around, fit);
    }
  }
  result.variation = fit.frame.variation;
  result.kind = fit.degree == parameters.degree ? VertexKind::Projected : VertexKind::LowerDegree;
  result.position = fit.foot + fit.height.g[0] * result.support * fit.frame.normal();
  result.normal = fit.frame.axes * Vec3(1, -fit.height.g[1], -fit.height.g[2]).normalized();
  result.nearest = around.nearestTo(points, result.position);
  return result;
}

// Keeps the first `count` neighbours whose normal is that of the side, or unknown.
void keepSide(const Vec3& normal, const std::vector<Vec3>& normals, double cone, int count,
              Neighborhood& around) {
  const auto isOfSide = [&](int i) {
    const Vec3& other = normals[around.index[i]];
    return other.squaredNorm() == 0 || std::abs(other.dot(normal)) > cone;
  };
  around.keepIf(isOfSide, count);
}

// The direction in which the weighted neighbours spread least about c itself.
struct LeastSpread {
  Vec3 direction;
  double deviation;  // root mean square along it
  double variation;
};

LeastSpread leastSpread(const std::vector<Vec3>& points, const Vec3& c,
                        const ProjectionParameters& parameters, Neighborhood& around) {
  around.weigh(points, c, around.supportRadius(around.localSpacing(), parameters));
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  double total = 0;
  for (int i = 0; i < around.count; ++i) {
    const Vec3 d = points[around.index[i]] - c;
    spread.noalias() += around.weight[i] * d * d.transpose();
    total += around.weight[i];
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  const Vec3 values = solver.eigenvalues().cwiseMax(0.0);
  const double sum = values.sum();
  return {solver.eigenvectors().col(0), std::sqrt(values[0] / total), sum > 0 ? values[0] / sum : 0.0};
}

}  // namespace

MlsSurface::MlsSurface(const std::vector<Vec3>& points, const NeighborSearch& search,
                       const ProjectionParameters& parameters, double residual_limit)
    : points_(points), search_(search), parameters_(parameters), residual_limit_(residual_limit) {
  assert(parameters.neighbors <= Neighborhood::kMost);
}

Projection MlsSurface::project(const Vec3& x, int degree) const {
  constexpr double kMissed = 0.15;  // local spacings
  Neighborhood around;
  Fit fit;
  around.find(search_, x, parameters_.neighbors);
  if (around.count == 0) return noProjection();
  const Projection whole =
      fitProjection(points_, parameters_, residual_limit_, x, degree, around.localSpacing(), around, fit);
  if (!mayMixSheets(whole.variation, parameters_) ||
      !mayMixSheets(rmsResidual(points_, fit, whole.support, around), kMissed * whole.spacing,
                    residual_limit_))
    return whole;
  const std::optional<Slab> slab = findSheet(points_, search_, x, whole.spacing, parameters_, around);
  if (!slab) return whole;
  Projection sheet =
      fitProjection(points_, parameters_, residual_limit_, x, degree, around.localSpacing(), around, fit);
  sheet.sheet_gap = slab->gap;
  return sheet;
}

Projection MlsSurface::projectSide(const Vec3& x, int degree, const Vec3& normal,
                                   const std::vector<Vec3>& normals, double cone) const {
  constexpr int kLeastSide = 6;
  Neighborhood around;
  around.find(search_, x, 2 * parameters_.neighbors);
  if (around.count == 0) return noProjection();
  const int nearest = std::min(around.count, parameters_.neighbors);
  const double spacing = std::sqrt(around.squared_distance[nearest - 1]) / std::sqrt(nearest / kPi);
  keepSide(normal, normals, cone, nearest, around);
  if (around.count < kLeastSide) return project(x, degree);
  Fit fit;
  return fitProjection(points_, parameters_, residual_limit_, x, degree, spacing, around, fit);
}

Vec3 MlsSurface::startFrom(const Vec3& c) const {
  constexpr double kMissed = 0.25;  // local spacings; a plane misses more than a polynomial
  Neighborhood around;
  around.find(search_, c, parameters_.neighbors);
  LeastSpread spread = leastSpread(points_, c, parameters_, around);
  const double spacing = around.localSpacing();
  if (mayMixSheets(spread.variation, parameters_) &&
      mayMixSheets(spread.deviation, kMissed * spacing, residual_limit_) &&
      findSheet(points_, search_, c, spacing, parameters_, around)) {
    spread = leastSpread(points_, c, parameters_, around);
  }
  return c + around.meanDifference(points_, c).dot(spread.direction) * spread.direction;
}

Vec3 MlsSurface::meanDifference(const Vec3& x) const {
  Neighborhood around;
  around.find(search_, x, parameters_.neighbors);
  return around.meanDifference(points_, x);
}

}  // namespace mlsmesh::core

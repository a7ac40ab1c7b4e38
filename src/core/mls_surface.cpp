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

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "near_sheets.h"

namespace mlsmesh::core {
namespace {

constexpr int kMaxNeighbors = 512;
constexpr double kPi = 3.14159265358979323846;
constexpr double kLeastSupport =
    1.5;  // local spacings, under which the residual test never shrinks a support
constexpr double kSupportStep = 1.07;  // a support this near to the least one is left alone
constexpr double kSupportShrink = 0.75;
constexpr int kLeastNeighbors = 12;

struct Neighborhood {
  std::array<Index, kMaxNeighbors> index;
  std::array<double, kMaxNeighbors> squared_distance;
  std::array<double, kMaxNeighbors> weight;
  int count = 0;
};

struct Frame {
  Vec3 centroid;
  Eigen::Matrix3d axes;  // columns: normal, then two tangents
  double variation = 0;
  Vec3 normal() const { return axes.col(0); }
};

// Weights are relative to the nearest neighbour's, so that they cannot all underflow however small h is.
void weigh(const std::vector<Vec3>& points, const Vec3& center, double support, Neighborhood& around) {
  double nearest = std::numeric_limits<double>::max();
  for (int i = 0; i < around.count; ++i) {
    around.squared_distance[i] = (points[around.index[i]] - center).squaredNorm();
    nearest = std::min(nearest, around.squared_distance[i]);
  }
  const double scale = 1.0 / (support * support);
  for (int i = 0; i < around.count; ++i) {
    around.weight[i] = std::exp((nearest - around.squared_distance[i]) * scale);
  }
}

Frame principalFrame(const std::vector<Vec3>& points, const Vec3& origin, const Neighborhood& around) {
  double total = 0;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < around.count; ++i) {
    mean += around.weight[i] * (points[around.index[i]] - origin);
    total += around.weight[i];
  }
  mean /= total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int i = 0; i < around.count; ++i) {
    const Vec3 d = points[around.index[i]] - origin - mean;
    covariance.noalias() += around.weight[i] * d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Vec3 values = solver.eigenvalues().cwiseMax(0.0);
  const double sum = values.sum();
  return {origin + mean, solver.eigenvectors(), sum > 0 ? values[0] / sum : 0.0};
}

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
    weigh(points, foot, support, around);
    if (settled) break;
    frame = principalFrame(points, x, around);
  }
  return frame;
}

template <int kTerms>
Eigen::Matrix<double, kTerms, 1> basis(double u, double v) {
  Eigen::Matrix<double, kTerms, 1> b;
  b[0] = 1;
  if constexpr (kTerms >= 3) {
    b[1] = u;
    b[2] = v;
  }
  if constexpr (kTerms >= 6) {
    b[3] = u * u;
    b[4] = u * v;
    b[5] = v * v;
  }
  if constexpr (kTerms >= 10) {
    b[6] = b[3] * u;
    b[7] = b[3] * v;
    b[8] = b[5] * u;
    b[9] = b[5] * v;
  }
  return b;
}

// Adds a b^T, of whose upper triangle the decomposition reads nothing; in steps of two columns, as the rest
// of each is added two numbers at a time.
template <int kTerms>
void addLower(const Eigen::Matrix<double, kTerms, 1>& a, const Eigen::Matrix<double, kTerms, 1>& b,
              Eigen::Matrix<double, kTerms, kTerms>& sum) {
  if constexpr (kTerms == 6) {
    sum.template block<6, 2>(0, 0).noalias() += a * b.template head<2>().transpose();
    sum.template block<4, 2>(2, 2).noalias() += a.template tail<4>() * b.template segment<2>(2).transpose();
    sum.template block<2, 2>(4, 4).noalias() += a.template tail<2>() * b.template tail<2>().transpose();
  } else {
    sum.noalias() += a * b.transpose();
  }
}

// Coefficients of the height over the frame, in units of the support; those beyond the degree are 0.
struct Height {
  Eigen::Matrix<double, 10, 1> g = Eigen::Matrix<double, 10, 1>::Zero();
  bool valid = false;
};

struct Fit {
  Frame frame;
  Vec3 foot;
  Height height;
  int degree = 0;
};

// Weighted least squares of the heights over the frame at `center`; lengths in units of the support. A small
// ridge on all but the constant keeps ill-posed fits finite without biasing good ones.
template <int kTerms>
Height fitHeight(const std::vector<Vec3>& points, const Vec3& center, const Frame& frame, double support,
                 const Neighborhood& around) {
  using Vector = Eigen::Matrix<double, kTerms, 1>;
  Eigen::Matrix<double, kTerms, kTerms> normal_matrix = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Vector right = Vector::Zero();
  for (int i = 0; i < around.count; ++i) {
    const Vec3 local = frame.axes.transpose() * (points[around.index[i]] - center) / support;
    const Vector b = basis<kTerms>(local[1], local[2]);
    const Vector weighted = around.weight[i] * b;
    addLower(weighted, b, normal_matrix);
    right += local[0] * weighted;
  }
  const double ridge = 1e-10 * normal_matrix(0, 0);
  for (int i = 1; i < kTerms; ++i) normal_matrix(i, i) += ridge;
  Height height;
  height.g.template head<kTerms>() = normal_matrix.ldlt().solve(right);
  height.valid = height.g.allFinite();
  return height;
}

Height fitHeight(int degree, const std::vector<Vec3>& points, const Vec3& center, const Frame& frame,
                 double support, const Neighborhood& around) {
  switch (degree) {
    case 0:
      return fitHeight<1>(points, center, frame, support, around);
    case 1:
      return fitHeight<3>(points, center, frame, support, around);
    case 2:
      return fitHeight<6>(points, center, frame, support, around);
    default:
      return fitHeight<10>(points, center, frame, support, around);
  }
}

// Fits the height over fit.frame at fit.foot, with a lower degree where it is not finite.
void fitWithFallback(const std::vector<Vec3>& points, int degree, double support, const Neighborhood& around,
                     Fit& fit) {
  fit.degree = degree;
  fit.height = fitHeight(fit.degree, points, fit.foot, fit.frame, support, around);
  while (!fit.height.valid && fit.degree > 0) {
    fit.height = fitHeight(--fit.degree, points, fit.foot, fit.frame, support, around);
  }
}

void fitInOneStep(const std::vector<Vec3>& points, const Vec3& x, int degree, double support,
                  const Neighborhood& around, Fit& fit) {
  fit.foot = x;
  fit.frame = principalFrame(points, x, around);
  fitWithFallback(points, degree, support, around, fit);
}

// Distance of neighbour i from the fitted polynomial along the normal of the frame.
double miss(const std::vector<Vec3>& points, const Fit& fit, double support, const Neighborhood& around,
            int i) {
  const Vec3 local = fit.frame.axes.transpose() * (points[around.index[i]] - fit.foot) / support;
  return support * (local[0] - fit.height.g.dot(basis<10>(local[1], local[2])));
}

double rmsResidual(const std::vector<Vec3>& points, const Fit& fit, double support,
                   const Neighborhood& around) {
  double sum = 0;
  double total = 0;
  for (int i = 0; i < around.count; ++i) {
    const double residual = miss(points, fit, support, around, i);
    sum += around.weight[i] * residual * residual;
    total += around.weight[i];
  }
  return std::sqrt(sum / total);
}

double medianResidual(const std::vector<Vec3>& points, const Fit& fit, double support,
                      const Neighborhood& around) {
  std::array<double, kMaxNeighbors> residual;
  for (int i = 0; i < around.count; ++i) residual[i] = std::abs(miss(points, fit, support, around, i));
  std::nth_element(residual.begin(), residual.begin() + around.count / 2, residual.begin() + around.count);
  return residual[around.count / 2];
}

// Forgets the neighbours beyond `distance`, but for the nearest ones that a quadric needs.
void truncate(double distance, Neighborhood& around) {
  while (around.count > kLeastNeighbors && around.squared_distance[around.count - 1] > distance * distance) {
    --around.count;
  }
}

double supportRadius(const Neighborhood& around, double spacing, const ProjectionParameters& parameters) {
  if (parameters.support_rule == SupportRule::LocalSpacing) return parameters.support_factor * spacing;
  int first = 0;
  while (first + 1 < around.count && around.squared_distance[first] == 0) ++first;
  return parameters.support_factor * std::sqrt(around.squared_distance[first]);
}

void findNeighbors(const NeighborSearch& search, const Vec3& x, const ProjectionParameters& parameters,
                   Neighborhood& around) {
  around.count = search.nearest(x, parameters.neighbors, around.index.data(), around.squared_distance.data());
}

// Keeps the first `count` neighbours within the slab.
void keepWithin(const std::vector<Vec3>& points, const Slab& slab, int count, Neighborhood& around) {
  int kept = 0;
  for (int i = 0; i < around.count && kept < count; ++i) {
    if (!slab.contains(points[around.index[i]])) continue;
    around.index[kept] = around.index[i];
    around.squared_distance[kept++] = around.squared_distance[i];
  }
  around.count = kept;
}

// d_k / sqrt(k / pi): the spacing of points spread evenly over a disc of radius d_k.
double localSpacing(const Neighborhood& around) {
  return std::sqrt(around.squared_distance[around.count - 1]) / std::sqrt(around.count / kPi);
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
  const int wanted = std::min(2 * parameters.neighbors, kMaxNeighbors);
  around.count = search.nearest(x, wanted, around.index.data(), around.squared_distance.data());
  keepWithin(points, *slab, parameters.neighbors, around);
  return slab;
}

Vec3 meanDifferenceOf(const std::vector<Vec3>& points, const Vec3& x, const Neighborhood& around) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < around.count; ++i) sum += points[around.index[i]] - x;
  return sum / around.count;
}

Index nearestTo(const std::vector<Vec3>& points, const Vec3& position, const Neighborhood& around) {
  Index best = around.index[0];
  double least = (points[best] - position).squaredNorm();
  for (int i = 1; i < around.count; ++i) {
    const double d = (points[around.index[i]] - position).squaredNorm();
    if (d < least || (d == least && around.index[i] < best)) {
      least = d;
      best = around.index[i];
    }
  }
  return best;
}

// Psi(x) from the neighbours given; their local spacing may be that of more points.
Projection fitProjection(const std::vector<Vec3>& points, const ProjectionParameters& parameters,
                         double residual_limit, const Vec3& x, int degree, double spacing,
                         Neighborhood& around, Fit& fit) {
  Projection result;
  result.spacing = spacing;
  result.support = supportRadius(around, result.spacing, parameters);
  result.mean_difference = meanDifferenceOf(points, x, around);

  weigh(points, x, result.support, around);
  if (parameters.method == ProjectionMethod::Levin) {
    fit.frame = alternatingFrame(points, x, result.spacing, result.support, parameters, around, fit.foot);
    fitWithFallback(points, degree, result.support, around, fit);
  } else {
    fitInOneStep(points, x, degree, result.support, around, fit);
    while (residual_limit > 0 && result.support > kLeastSupport * kSupportStep * result.spacing &&
           rmsResidual(points, fit, result.support, around) > residual_limit) {
      result.support = std::max(kLeastSupport * result.spacing, kSupportShrink * result.support);
      truncate(2 * result.support, around);
      weigh(points, x, result.support, around);
      fitInOneStep(points, x, degree, result.support, around, fit);
    }
  }
  result.variation = fit.frame.variation;
  result.kind = fit.degree == parameters.degree ? VertexKind::Projected : VertexKind::LowerDegree;
  result.position = fit.foot + fit.height.g[0] * result.support * fit.frame.normal();
  result.normal = fit.frame.axes * Vec3(1, -fit.height.g[1], -fit.height.g[2]).normalized();
  result.nearest = nearestTo(points, result.position, around);
  return result;
}

void forget(Index point, Neighborhood& around) {
  int kept = 0;
  for (int i = 0; i < around.count; ++i) {
    around.index[kept] = around.index[i];
    around.squared_distance[kept] = around.squared_distance[i];
    if (around.index[i] != point) ++kept;
  }
  around.count = kept;
}

// Keeps the neighbours that the fit misses by `limit` at most.
void keepWithin(const std::vector<Vec3>& points, double limit, const Fit& fit, double support,
                Neighborhood& around) {
  int kept = 0;
  for (int i = 0; i < around.count; ++i) {
    const bool near = std::abs(miss(points, fit, support, around, i)) <= limit;
    around.index[kept] = around.index[i];
    around.squared_distance[kept] = around.squared_distance[i];
    around.weight[kept] = around.weight[i];
    if (near) ++kept;
  }
  around.count = kept;
}

// Keeps the first `count` neighbours whose normal is that of the side, or unknown.
void keepSide(const Vec3& normal, const std::vector<Vec3>& normals, double cone, int count,
              Neighborhood& around) {
  int kept = 0;
  for (int i = 0; i < around.count && kept < count; ++i) {
    const Vec3& other = normals[around.index[i]];
    if (other.squaredNorm() > 0 && std::abs(other.dot(normal)) <= cone) continue;
    around.index[kept] = around.index[i];
    around.squared_distance[kept++] = around.squared_distance[i];
  }
  around.count = kept;
}

// The direction in which the weighted neighbours spread least about c itself.
struct LeastSpread {
  Vec3 direction;
  double deviation;  // root mean square along it
  double variation;
};

LeastSpread leastSpread(const std::vector<Vec3>& points, const Vec3& c,
                        const ProjectionParameters& parameters, Neighborhood& around) {
  weigh(points, c, supportRadius(around, localSpacing(around), parameters), around);
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
  assert(parameters.neighbors <= kMaxNeighbors);
}

Projection MlsSurface::project(const Vec3& x, int degree) const {
  constexpr double kMissed = 0.15;  // local spacings
  Neighborhood around;
  Fit fit;
  findNeighbors(search_, x, parameters_, around);
  const Projection whole =
      fitProjection(points_, parameters_, residual_limit_, x, degree, localSpacing(around), around, fit);
  if (!mayMixSheets(whole.variation, parameters_) ||
      !mayMixSheets(rmsResidual(points_, fit, whole.support, around), kMissed * whole.spacing,
                    residual_limit_))
    return whole;
  const std::optional<Slab> slab = findSheet(points_, search_, x, whole.spacing, parameters_, around);
  if (!slab) return whole;
  Projection sheet =
      fitProjection(points_, parameters_, residual_limit_, x, degree, localSpacing(around), around, fit);
  sheet.sheet_gap = slab->gap;
  return sheet;
}

Projection MlsSurface::projectSide(const Vec3& x, int degree, const Vec3& normal,
                                   const std::vector<Vec3>& normals, double cone) const {
  constexpr int kLeastSide = 6;
  Neighborhood around;
  const int wanted = std::min(2 * parameters_.neighbors, kMaxNeighbors);
  around.count = search_.nearest(x, wanted, around.index.data(), around.squared_distance.data());
  const int nearest = std::min(around.count, parameters_.neighbors);
  const double spacing = std::sqrt(around.squared_distance[nearest - 1]) / std::sqrt(nearest / kPi);
  keepSide(normal, normals, cone, nearest, around);
  if (around.count < kLeastSide) return project(x, degree);
  Fit fit;
  return fitProjection(points_, parameters_, residual_limit_, x, degree, spacing, around, fit);
}

// A first plane leads from the point to the place on the surface below it; what counts is the distance from
// the surface fitted there, once more without the neighbours that it misses most: other strays.
bool MlsSurface::isStray(Index point, double distance) const {
  constexpr double kResiduals = 6;  // median residuals of the neighbours
  constexpr double kSupport =
      3;  // local spacings: weights nearly even, so that strays do not vouch for each other
  constexpr double kClear = 0.5;  // share of the distance that even a plane bent by strays leaves
  constexpr int kCompany = 2;     // points nearer than the surface: other strays; more are a part of it
  const Vec3& x = points_[point];
  Neighborhood around;
  findNeighbors(search_, x, parameters_, around);
  forget(point, around);
  if (around.count < kLeastNeighbors) return false;
  Fit fit;
  double support = kSupport * localSpacing(around);
  weigh(points_, x, support, around);
  fitInOneStep(points_, x, 1, support, around, fit);
  if (std::abs(fit.height.g[0]) * kSupport < kClear * distance) return false;
  const Vec3 foot = x + fit.height.g[0] * support * fit.frame.normal();
  const Neighborhood around_point = around;

  findNeighbors(search_, foot, parameters_, around);
  forget(point, around);
  const double spacing = localSpacing(around);
  support = kSupport * spacing;
  weigh(points_, foot, support, around);
  fitInOneStep(points_, foot, 1, support, around, fit);
  keepWithin(points_, kResiduals * medianResidual(points_, fit, support, around), fit, support, around);
  fitInOneStep(points_, foot, std::min(2, parameters_.degree), support, around, fit);
  const double offset = std::abs((x - foot).dot(fit.frame.normal()) - fit.height.g[0] * support);
  const auto* const distances = around_point.squared_distance.data();
  const auto nearer = std::count_if(distances, distances + around_point.count,
                                    [&](double squared) { return squared < offset * offset; });
  return offset > distance * spacing && nearer <= kCompany &&
         offset > kResiduals * medianResidual(points_, fit, support, around);
}

Vec3 MlsSurface::startFrom(const Vec3& c) const {
  constexpr double kMissed = 0.25;  // local spacings; a plane misses more than a polynomial
  Neighborhood around;
  findNeighbors(search_, c, parameters_, around);
  LeastSpread spread = leastSpread(points_, c, parameters_, around);
  const double spacing = localSpacing(around);
  if (mayMixSheets(spread.variation, parameters_) &&
      mayMixSheets(spread.deviation, kMissed * spacing, residual_limit_) &&
      findSheet(points_, search_, c, spacing, parameters_, around)) {
    spread = leastSpread(points_, c, parameters_, around);
  }
  return c + meanDifferenceOf(points_, c, around).dot(spread.direction) * spread.direction;
}

Vec3 MlsSurface::meanDifference(const Vec3& x) const {
  Neighborhood around;
  findNeighbors(search_, x, parameters_, around);
  return meanDifferenceOf(points_, x, around);
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
// This work is based on S. Fleishman, D. Cohen-Or, C. T. Silva, "Robust moving least-squares fitting with
// sharp features", SIGGRAPH 2005: a neighbourhood that holds a sharp feature is fitted side by side, each
// side by a polynomial of its own.
#include "surface_patch.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace mlsmesh::core {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr int kLeastForGraph = 8;     // points that a graph of degree 2 is fitted to
constexpr double kMayClimb = 0.5;     // supports
constexpr double kLeastCosine = 0.8;  // of the graph's normal with the plane's
constexpr double kRidge = 1e-10;
constexpr int kMostPoints = 64;
constexpr int kTurns = 4;      // of assigning points to two planes and fitting those
constexpr int kLeastPart = 4;  // points of one of two planes

struct PrincipalAxes {
  Vec3 centroid;
  Eigen::Matrix3d axes;
};

template <typename Weight>
PrincipalAxes principalAxes(const std::vector<Vec3>& points, const Index* members, int count,
                            const Weight& weight) {
  const Vec3& origin = points[members[0]];
  Vec3 mean = Vec3::Zero();
  double total = 0;
  for (int i = 0; i < count; ++i) {
    mean += weight(i) * (points[members[i]] - origin);
    total += weight(i);
  }
  mean /= total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int i = 0; i < count; ++i) {
    const Vec3 d = points[members[i]] - origin - mean;
    covariance.noalias() += weight(i) * d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  return {origin + mean, solver.eigenvectors()};
}

Vector6 basis(double u, double v) {
  Vector6 b;
  b << 1, u, v, u * u, u * v, v * v;
  return b;
}

template <typename Weight>
Vector6 fitGraph(const std::vector<Vec3>& points, const Index* members, int count, const PrincipalAxes& frame,
                 double unit, const Weight& weight) {
  Matrix6 matrix = Matrix6::Zero();
  Vector6 right = Vector6::Zero();
  for (int i = 0; i < count; ++i) {
    const Vec3 local = frame.axes.transpose() * (points[members[i]] - frame.centroid) / unit;
    const Vector6 b = basis(local[1], local[2]);
    const Vector6 weighted = weight(i) * b;
    matrix.noalias() += weighted * b.transpose();
    right += local[0] * weighted;
  }
  const double ridge = kRidge * matrix(0, 0);
  for (int i = 1; i < 6; ++i) matrix(i, i) += ridge;
  return matrix.ldlt().solve(right);
}

}  // namespace

SurfacePatch::SurfacePatch(const std::vector<Vec3>& points, const Index* members, int count,
                           const Vec3& center, double support)
    : support_(support) {
  const double scale = 1.0 / (support * support);
  double nearest = (points[members[0]] - center).squaredNorm();
  for (int i = 1; i < count; ++i) nearest = std::min(nearest, (points[members[i]] - center).squaredNorm());
  const auto weight = [&](int i) {
    return std::exp((nearest - (points[members[i]] - center).squaredNorm()) * scale);
  };
  const PrincipalAxes frame = principalAxes(points, members, count, weight);
  centroid_ = frame.centroid;
  axes_ = frame.axes;
  for (int i = 0; i < count; ++i) {
    const double off = (points[members[i]] - centroid_).dot(normal());
    plane_residual_ += off * off / count;
  }
  if (count >= kLeastForGraph) graph_ = fitGraph(points, members, count, frame, support, weight);
}

TangentPlane SurfacePatch::tangentAt(const Vec3& x) const {
  const Vec3 local = axes_.transpose() * (x - centroid_) / support_;
  const double u = local[1], v = local[2];
  const double height = graph_.dot(basis(u, v));
  const double du = graph_[1] + 2 * graph_[3] * u + graph_[4] * v;
  const double dv = graph_[2] + graph_[4] * u + 2 * graph_[5] * v;
  const double length = std::sqrt(1 + du * du + dv * dv);
  if (!(std::abs(height) < kMayClimb && length * kLeastCosine < 1)) return {centroid_, normal()};
  return {centroid_ + support_ * (axes_ * Vec3(height, u, v)), axes_ * Vec3(1, -du, -dv) / length};
}

namespace {

struct Quadric {
  PrincipalAxes frame;
  Vector6 graph;
  double unit;

  Vec3 local(const Vec3& x) const { return frame.axes.transpose() * (x - frame.centroid) / unit; }
};

Quadric fitQuadric(const std::vector<Vec3>& points, const Index* members, int count) {
  const auto equal = [](int) { return 1.0; };
  Quadric quadric;
  quadric.frame = principalAxes(points, members, count, equal);
  quadric.unit = (points[members[count - 1]] - points[members[0]]).norm();
  quadric.graph = fitGraph(points, members, count, quadric.frame, quadric.unit, equal);
  return quadric;
}

double residualOf(const Quadric& quadric, const std::vector<Vec3>& points, const Index* members, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const Vec3 local = quadric.local(points[members[i]]);
    const double off = local[0] - quadric.graph.dot(basis(local[1], local[2]));
    sum += off * off;
  }
  return quadric.unit * std::sqrt(sum / count);
}

// The direction of largest curvature in the quadric's tangents.
Eigen::Vector2d steepest(const Quadric& quadric) {
  const double a = quadric.graph[3], b = 0.5 * quadric.graph[4], c = quadric.graph[5];
  const double angle = 0.5 * std::atan2(2 * b, a - c);
  const Eigen::Vector2d first(std::cos(angle), std::sin(angle));
  const double along = a * first[0] * first[0] + 2 * b * first[0] * first[1] + c * first[1] * first[1];
  return std::abs(along) >= std::abs(a + c - along) ? first : Eigen::Vector2d(-first[1], first[0]);
}

double foldedResidual(const Quadric& quadric, const std::vector<Vec3>& points, const Index* members,
                      int count) {
  const Eigen::Vector2d across = steepest(quadric);
  std::array<unsigned char, kMostPoints> side{};
  for (int i = 0; i < count; ++i) {
    const Vec3 local = quadric.local(points[members[i]]);
    side[static_cast<std::size_t>(i)] = across[0] * local[1] + across[1] * local[2] > 0;
  }
  double residual = std::numeric_limits<double>::max();
  for (int turn = 0; turn < kTurns; ++turn) {
    std::array<std::array<Index, kMostPoints>, 2> parts;
    std::array<int, 2> size{};
    for (int i = 0; i < count; ++i) {
      const std::size_t s = side[static_cast<std::size_t>(i)];
      parts[s][static_cast<std::size_t>(size[s]++)] = members[i];
    }
    if (std::min(size[0], size[1]) < kLeastPart) return residual;
    const auto equal = [](int) { return 1.0; };
    const PrincipalAxes planes[2] = {principalAxes(points, parts[0].data(), size[0], equal),
                                     principalAxes(points, parts[1].data(), size[1], equal)};
    double sum = 0;
    for (int i = 0; i < count; ++i) {
      const double first = std::abs((points[members[i]] - planes[0].centroid).dot(planes[0].axes.col(0)));
      const double second = std::abs((points[members[i]] - planes[1].centroid).dot(planes[1].axes.col(0)));
      side[static_cast<std::size_t>(i)] = second < first;
      sum += std::min(first, second) * std::min(first, second);
    }
    residual = std::sqrt(sum / count);
  }
  return residual;
}

}  // namespace

double quadricResidual(const std::vector<Vec3>& points, const Index* members, int count) {
  return residualOf(fitQuadric(points, members, count), points, members, count);
}

Misfit misfitOf(const std::vector<Vec3>& points, const Index* members, int count, double enough) {
  assert(count <= kMostPoints);
  const Quadric quadric = fitQuadric(points, members, count);
  Misfit misfit;
  misfit.smooth = misfit.folded = residualOf(quadric, points, members, count);
  if (misfit.smooth > enough) misfit.folded = foldedResidual(quadric, points, members, count);
  return misfit;
}

}  // namespace mlsmesh::core

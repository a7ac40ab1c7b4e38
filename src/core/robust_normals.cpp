// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - J. Cao, H. Chen, J. Zhang, Y. Li, X. Liu, C. Zou, "Normal estimation via shifted neighborhood for point
//   cloud", J. Computational and Applied Mathematics 2018: near a sharp edge a point takes the plane of a
//   neighbour that lies on one side, chosen by how flat it is and how near it passes.
// - T. R. Jones, F. Durand, M. Zwicker, "Normal improvement for point rendering", CG&A 2004: a bilateral
//   average of the normals that agree.
#include "robust_normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

constexpr int kPlanePoints = 10;  // of the first plane, the point itself included
constexpr int kShifts = 16;       // neighbours whose plane may be taken
constexpr int kAveraged = 12;     // neighbours in the bilateral average
constexpr double kFlat =
    0.002;  // spread off the plane, in squared local spacings, of a point that needs no help
constexpr double kMissWeight = 0.5;    // of the squared distance between point and plane
constexpr double kFarWeight = 0.1;     // of the squared distance between the two points
constexpr double kSimilar = 0.85;      // cosine of normals that are averaged
constexpr double kBilateralDecay = 8;  // per squared local spacing off the plane

}  // namespace

RobustNormals::Plane RobustNormals::planeAt(Index point) const {
  const std::vector<Vec3>& x = neighbors_.positions();
  const Index* row = neighbors_.row(point);
  const int count = std::min(kPlanePoints, neighbors_.k());
  Vec3 mean = Vec3::Zero();
  for (int i = 1; i < count; ++i) mean += x[row[i]] - x[point];
  mean /= count;
  Eigen::Matrix3d scatter = mean * mean.transpose();
  for (int i = 1; i < count; ++i) {
    const Vec3 d = x[row[i]] - x[point] - mean;
    scatter.noalias() += d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(scatter);
  const double spacing = neighbors_.spacing(point);
  return {solver.eigenvectors().col(0), x[point] + mean,
          std::max(solver.eigenvalues()[0], 0.0) / (count * spacing * spacing)};
}

bool RobustNormals::isFlat(Index point) const {
  return plane(point).spread <= kFlat;
}

void RobustNormals::addPlanes(const Context& context) {
  const std::size_t before = planes_.size();
  planes_.resize(static_cast<std::size_t>(neighbors_.count()));
  parallelBlocks(context, planes_.size() - before, 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = before + first; s < before + last; ++s) {
      planes_[s] = planeAt(neighbors_.point(static_cast<Index>(s)));
    }
  });
}

// The normal of the plane, among those of the point and its neighbours, that fits it best.
Vec3 RobustNormals::shifted(Index point) const {
  const std::vector<Vec3>& x = neighbors_.positions();
  const double unit = 1 / neighbors_.spacing(point);
  const Index* row = neighbors_.row(point);
  Index best = point;
  double least = std::numeric_limits<double>::max();
  for (int i = 0; i < std::min(kShifts + 1, neighbors_.k()); ++i) {
    const Plane& other = plane(row[i]);
    const double miss = unit * other.normal.dot(x[point] - other.centroid);
    const double far = unit * unit * (x[row[i]] - x[point]).squaredNorm();
    const double cost = (other.spread + kFlat + kMissWeight * miss * miss) * (1 + kFarWeight * far);
    if (cost < least) {
      least = cost;
      best = row[i];
    }
  }
  return plane(best).normal;
}

// The mean of the normals around that agree with the point's own and whose planes pass near it.
Vec3 RobustNormals::averaged(Index point) const {
  const std::vector<Vec3>& x = neighbors_.positions();
  const Vec3& own = normal_[point];
  const double unit = 1 / neighbors_.spacing(point);
  const Index* row = neighbors_.row(point);
  Vec3 sum = own;
  for (int i = 1; i < std::min(kAveraged + 1, neighbors_.k()); ++i) {
    const Vec3& other = knows(row[i]) ? normal_[row[i]] : plane(row[i]).normal;
    const double cosine = other.dot(own);
    if (std::abs(cosine) <= kSimilar) continue;
    const double miss = unit * other.dot(x[point] - x[row[i]]);
    sum += std::copysign(std::exp(-kBilateralDecay * miss * miss), cosine) * other;
  }
  return sum.normalized();
}

void RobustNormals::add(const std::vector<Index>& wanted, const Context& context) {
  neighbors_.add(wanted, context);
  std::vector<Index> missing, bent;
  for (const Index p : wanted) {
    if (!knows(p)) missing.push_back(p);
  }
  neighbors_.add(neighbors_.grown(missing, kShifts + 1), context);
  addPlanes(context);
  for (const Index p : missing) {
    normal_[p] = plane(p).normal;
    if (!isFlat(p)) bent.push_back(p);
  }
  std::vector<Vec3> better(bent.size());
  const auto improve = [&](Vec3 (RobustNormals::*normalOf)(Index) const) {
    parallelBlocks(context, bent.size(), 512, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) better[i] = (this->*normalOf)(bent[i]);
    });
    for (std::size_t i = 0; i < bent.size(); ++i) normal_[bent[i]] = better[i];
  };
  improve(&RobustNormals::shifted);
  improve(&RobustNormals::averaged);
}

}  // namespace mlsmesh::core

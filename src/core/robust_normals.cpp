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

struct Plane {
  Vec3 normal;
  Vec3 centroid;
  double spread = 0;  // off the plane, in squared local spacings
};

Plane planeAt(const SparseNeighbors& neighbors, Index point) {
  const std::vector<Vec3>& x = neighbors.positions();
  const Index* row = neighbors.row(point);
  const int count = std::min(kPlanePoints, neighbors.k());
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
  const double spacing = neighbors.spacing(point);
  return {solver.eigenvectors().col(0), x[point] + mean,
          std::max(solver.eigenvalues()[0], 0.0) / (count * spacing * spacing)};
}

class NormalBuilder {
 public:
  NormalBuilder(const SparseNeighbors& neighbors, const std::vector<Plane>& planes)
      : neighbors_(neighbors), x_(neighbors.positions()), planes_(planes) {}

  bool isFlat(Index point) const { return plane(point).spread <= kFlat; }

  /// The normal of the plane, among those of the point and its neighbours, that fits it best.
  Vec3 shifted(Index point) const {
    if (isFlat(point)) return plane(point).normal;
    const double unit = 1 / neighbors_.spacing(point);
    const Index* row = neighbors_.row(point);
    Index best = point;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < std::min(kShifts + 1, neighbors_.k()); ++i) {
      const Plane& other = plane(row[i]);
      const double miss = unit * other.normal.dot(x_[point] - other.centroid);
      const double far = unit * unit * (x_[row[i]] - x_[point]).squaredNorm();
      const double cost = (other.spread + kFlat + kMissWeight * miss * miss) * (1 + kFarWeight * far);
      if (cost < least) {
        least = cost;
        best = row[i];
      }
    }
    return plane(best).normal;
  }

  /// The mean of the normals around that agree with the point's own and whose planes pass near it.
  template <typename NormalAt>
  Vec3 averaged(Index point, const NormalAt& normalAt) const {
    const Vec3 own = normalAt(point);
    const double unit = 1 / neighbors_.spacing(point);
    const Index* row = neighbors_.row(point);
    Vec3 sum = own;
    for (int i = 1; i < std::min(kAveraged + 1, neighbors_.k()); ++i) {
      const Vec3 other = normalAt(row[i]);
      const double cosine = other.dot(own);
      if (std::abs(cosine) <= kSimilar) continue;
      const double miss = unit * other.dot(x_[point] - x_[row[i]]);
      sum += std::copysign(std::exp(-kBilateralDecay * miss * miss), cosine) * other;
    }
    return sum.normalized();
  }

  Vec3 planeNormal(Index point) const { return plane(point).normal; }

 private:
  const Plane& plane(Index point) const { return planes_[neighbors_.slot(point)]; }

  const SparseNeighbors& neighbors_;
  const std::vector<Vec3>& x_;
  const std::vector<Plane>& planes_;
};

}  // namespace

void addRobustNormals(const std::vector<Index>& wanted, SparseNeighbors& neighbors, const Context& context,
                      RobustNormals& normals) {
  std::vector<Index> missing;
  for (const Index p : wanted) {
    if (!normals.knows(p)) missing.push_back(p);
  }
  if (normals.normal.empty()) normals.normal.assign(neighbors.positions().size(), Vec3::Zero());
  neighbors.add(missing, context);
  neighbors.add(neighbors.grown(missing, kShifts + 1), context);

  std::vector<Plane> planes(static_cast<std::size_t>(neighbors.count()));
  parallelBlocks(context, planes.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t s = first; s < last; ++s) {
      planes[s] = planeAt(neighbors, neighbors.point(static_cast<Index>(s)));
    }
  });
  const NormalBuilder builder(neighbors, planes);
  std::vector<Vec3> shifted(missing.size());
  parallelBlocks(context, missing.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) shifted[i] = builder.shifted(missing[i]);
  });
  for (std::size_t i = 0; i < missing.size(); ++i) normals.normal[missing[i]] = shifted[i];
  const auto normalAt = [&](Index p) {
    return normals.knows(p) ? normals.normal[p] : builder.planeNormal(p);
  };
  parallelBlocks(context, missing.size(), 512, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      shifted[i] = builder.isFlat(missing[i]) ? builder.planeNormal(missing[i])
                                              : builder.averaged(missing[i], normalAt);
    }
  });
  for (std::size_t i = 0; i < missing.size(); ++i) normals.normal[missing[i]] = shifted[i];
}

}  // namespace mlsmesh::core

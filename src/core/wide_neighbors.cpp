// SPDX-License-Identifier: BSD-3-Clause
// Related: L. Linsen, H. Prautzsch, "Local versus global triangulations", Eurographics 2001: neighbours
// chosen by angle, where the nearest ones would all lie on one side.
#include "wide_neighbors.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {
namespace {

constexpr int kWide = 96;
constexpr int kDirections = 8;
constexpr double kPi = 3.14159265358979323846;

struct Wide {
  std::array<Index, kWide + 1> index;
  std::array<double, kWide + 1> squared_distance;
  int count = 0;
};

Wide nearestOthers(const std::vector<Vec3>& points, const NeighborSearch& search, Index point) {
  Wide wide;
  const int found = search.nearest(points[point], kWide + 1, wide.index.data(), wide.squared_distance.data());
  for (int i = 0; i < found; ++i) {
    if (wide.index[i] == point) continue;
    wide.index[wide.count] = wide.index[i];
    wide.squared_distance[wide.count++] = wide.squared_distance[i];
  }
  return wide;
}

// Of the plane along which the directions to the neighbours lie, whatever their distance.
Eigen::Matrix3d frameOf(const std::vector<Vec3>& points, Index point, const Wide& wide) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (int i = 0; i < wide.count; ++i) {
    const Vec3 d = points[wide.index[i]] - points[point];
    sum += d * d.transpose() / wide.squared_distance[i];
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(sum);
  return solver.eigenvectors();
}

// For each direction that has any, its neighbours are taken in turn, nearest first, until there are `most`.
std::vector<int> inAllDirections(const std::vector<Vec3>& points, Index point, const Wide& wide,
                                 const Eigen::Matrix3d& frame, int most, double& spacing) {
  std::array<std::vector<int>, kDirections> of_direction;
  for (int i = 0; i < wide.count; ++i) {
    const Vec3 local = frame.transpose() * (points[wide.index[i]] - points[point]);
    const double turn = (std::atan2(local[2], local[1]) + kPi) / (2 * kPi);
    of_direction[static_cast<std::size_t>(std::min(turn, 0.999) * kDirections)].push_back(i);
  }
  double sum = 0;
  int filled = 0;
  for (const std::vector<int>& members : of_direction) {
    if (members.empty()) continue;
    sum += std::sqrt(wide.squared_distance[members[0]]);
    ++filled;
  }
  spacing = sum / filled;
  std::vector<int> chosen;
  for (std::size_t rank = 0; static_cast<int>(chosen.size()) < most; ++rank) {
    for (const std::vector<int>& members : of_direction) {
      if (rank < members.size() && static_cast<int>(chosen.size()) < most) chosen.push_back(members[rank]);
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace

void widenLines(const std::vector<Vec3>& points, const std::vector<char>& on_line,
                const NeighborSearch& search, const Context& context, NeighborTable& neighbors,
                std::vector<double>& spacing, std::vector<Vec3>& normals) {
  parallelBlocks(context, points.size(), 1024, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      if (!on_line[i]) continue;
      const Index point = static_cast<Index>(i);
      const Wide wide = nearestOthers(points, search, point);
      const Eigen::Matrix3d frame = frameOf(points, point, wide);
      const std::vector<int> row =
          inAllDirections(points, point, wide, frame, std::min(neighbors.k, wide.count), spacing[i]);
      for (std::size_t j = 0; j < row.size(); ++j)
        neighbors.indices[i * static_cast<std::size_t>(neighbors.k) + j] = wide.index[row[j]];
      normals[i] = frame.col(0);
    }
  });
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
#include "neighborhood.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mlsmesh::core {
namespace {

constexpr double kPi = 3.14159265358979323846;

}  // namespace

void Neighborhood::find(const NeighborSearch& search, const Vec3& x, int wanted) {
  count = search.nearest(x, std::min(wanted, kMost), index.data(), squared_distance.data());
  is_weighted = false;
}

void Neighborhood::weigh(const std::vector<Vec3>& points, const Vec3& center, double support) {
  double nearest = std::numeric_limits<double>::max();
  for (int i = 0; i < count; ++i) {
    squared_distance[i] = (points[index[i]] - center).squaredNorm();
    nearest = std::min(nearest, squared_distance[i]);
  }
  is_weighted = true;
  const double inverse = 1.0 / (support * support);
  const double scale = std::isfinite(inverse) ? inverse : 0.0;  // no distance is told from another
  for (int i = 0; i < count; ++i) weight[i] = std::exp((nearest - squared_distance[i]) * scale);
}

double Neighborhood::localSpacing() const {
  return std::sqrt(squared_distance[count - 1]) / std::sqrt(count / kPi);
}

double Neighborhood::supportRadius(double local_spacing, const ProjectionParameters& parameters) const {
  constexpr double kLeast = std::numeric_limits<double>::min();
  if (parameters.support_rule == SupportRule::LocalSpacing)
    return std::max(kLeast, parameters.support_factor * local_spacing);
  int first = 0;
  while (first + 1 < count && squared_distance[first] == 0) ++first;
  return std::max(kLeast, parameters.support_factor * std::sqrt(squared_distance[first]));
}

Vec3 Neighborhood::meanDifference(const std::vector<Vec3>& points, const Vec3& x) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < count; ++i) sum += points[index[i]] - x;
  return sum / count;
}

Index Neighborhood::nearestTo(const std::vector<Vec3>& points, const Vec3& position) const {
  Index best = index[0];
  double least = (points[best] - position).squaredNorm();
  for (int i = 1; i < count; ++i) {
    const double d = (points[index[i]] - position).squaredNorm();
    if (d < least || (d == least && index[i] < best)) {
      least = d;
      best = index[i];
    }
  }
  return best;
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_support.h"

#include <algorithm>

namespace mlsmesh::core {

// The points nearest to the corners of the triangle are tried first: most often one of them is near enough.
bool CloudSupport::isNear(const Vec3& position, const Triangle& triangle, double distance) const {
  const double limit = distance * distance;
  if (cloud_points_) {
    for (const Index corner : triangle) {
      if (((*cloud_points_)[(*nearest_)[corner]] - position).squaredNorm() <= limit) return true;
    }
  }
  Index nearest;
  double squared;
  cloud_->nearest(position, 1, &nearest, &squared);
  return squared <= limit;
}

bool CloudSupport::supports(const Triangle& triangle, double reach) const {
  if (!cloud_) return true;
  const auto& [a, b, c] = triangle;
  const Vec3 &pa = (*points_)[a], &pb = (*points_)[b], &pc = (*points_)[c];
  const double distance = reach * std::max({(*spacing_)[a], (*spacing_)[b], (*spacing_)[c]});
  const double longest = std::max({(pa - pb).norm(), (pb - pc).norm(), (pc - pa).norm()});
  if (longest <= distance) return true;  // its corners lie on the surface of the cloud
  const auto near = [&](const Vec3& position) { return isNear(position, triangle, distance); };
  return near((pa + pb + pc) / 3) && near((pa + pb) / 2) && near((pb + pc) / 2) && near((pc + pa) / 2);
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_support.h"

#include <algorithm>

namespace mlsmesh::core {

bool CloudSupport::isNear(const Vec3& position, double distance) const {
  Index nearest;
  double squared;
  cloud_->nearest(position, 1, &nearest, &squared);
  return squared <= distance * distance;
}

bool CloudSupport::supports(const Triangle& triangle, double reach) const {
  if (!cloud_) return true;
  const auto& [a, b, c] = triangle;
  const Vec3 &pa = (*points_)[a], &pb = (*points_)[b], &pc = (*points_)[c];
  const double distance = reach * std::max({(*spacing_)[a], (*spacing_)[b], (*spacing_)[c]});
  const double longest = std::max({(pa - pb).norm(), (pb - pc).norm(), (pc - pa).norm()});
  if (longest <= distance) return true;  // its corners lie on the surface of the cloud
  return isNear((pa + pb + pc) / 3, distance) && isNear((pa + pb) / 2, distance) &&
         isNear((pb + pc) / 2, distance) && isNear((pc + pa) / 2, distance);
}

}  // namespace mlsmesh::core

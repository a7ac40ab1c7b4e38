// SPDX-License-Identifier: BSD-3-Clause
// This work is based on C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.5: the part of a
// triangle that is nearest to a point, told by the signs of barycentric coordinates. The boxes are Eigen's.
#include "triangle_tree.h"

#include <algorithm>
#include <limits>

namespace mlsmesh::core {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double squaredDistanceToSegment(const Vec3& point, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a, from = point - a;
  const double length = along.squaredNorm();
  const double share = length > 0 ? std::clamp(from.dot(along) / length, 0.0, 1.0) : 0.0;
  return (from - share * along).squaredNorm();
}

}  // namespace

double squaredDistance(const Vec3& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = point - a;
  const Vec3 normal = ab.cross(ac);
  const double size = normal.squaredNorm();
  const double at_c = normal.dot(ab.cross(ap)), at_b = normal.dot(ap.cross(ac));  // barycentric, times size
  const bool is_above = size > 0 && at_b >= 0 && at_c >= 0 && at_b + at_c <= size;
  if (is_above) {
    const double height = normal.dot(ap);
    return height * height / size;
  }
  return std::min({squaredDistanceToSegment(point, a, b), squaredDistanceToSegment(point, b, c),
                   squaredDistanceToSegment(point, c, a)});
}

/// What Eigen's search asks of boxes and of what is in them.
struct TriangleTree::Search {
  using Scalar = double;

  explicit Search(const Vec3& query) : point(query) {}

  /// Infinite, so that it is not looked into, where nothing nearer than the best can be.
  double minimumOnVolume(const Eigen::AlignedBox3d& box) const {
    const double distance = box.squaredExteriorDistance(point);
    return distance < best.squared_distance ? distance : kInfinity;
  }
  double minimumOnObject(const Item& item) {
    const double distance = squaredDistance(point, item.a, item.b, item.c);
    if (distance < best.squared_distance) best = {item.triangle, distance};
    return distance;
  }

  const Vec3& point;
  Nearest best{kNone, kInfinity};
};

TriangleTree::TriangleTree(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles)
    : vertices_(vertices), triangles_(triangles) {
  std::vector<Item> items;
  std::vector<Eigen::AlignedBox3d> boxes;
  items.reserve(triangles.size());
  boxes.reserve(triangles.size());
  for (const auto& [i, j, k] : triangles) {
    items.push_back({vertices[i], vertices[j], vertices[k], static_cast<Index>(items.size())});
    boxes.emplace_back(vertices[i]);
    boxes.back().extend(vertices[j]).extend(vertices[k]);
  }
  boxes_.init(items.begin(), items.end(), boxes.begin(), boxes.end());
}

TriangleTree::Nearest TriangleTree::nearest(const Vec3& point, Index hint) const {
  Search search(point);
  if (hint != kNone) {
    const auto& [a, b, c] = triangles_[hint];
    search.best = {hint, squaredDistance(point, vertices_[a], vertices_[b], vertices_[c])};
  }
  Eigen::BVMinimize(boxes_, search);
  return search.best;
}

}  // namespace mlsmesh::core

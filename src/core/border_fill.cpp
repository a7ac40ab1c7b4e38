// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - G. Barequet, M. Sharir, "Filling gaps in the boundary of a polyhedron", 1995: the triangulation of a loop
// by dynamic
//   programming.
// - P. Liepa, "Filling holes in meshes", SGP 2003: its weight, worst dihedral angle first, then area.
#include "border_fill.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr double kWorstBend = 165.0 * 3.14159265358979323846 / 180.0;
constexpr double kSliver = 1e-6;

struct Weight {
  double bend = std::numeric_limits<double>::infinity();
  double area = 0;

  bool operator<(const Weight& other) const {
    return bend < other.bend || (bend == other.bend && area < other.area);
  }
};

// Fills polygon w_0 .. w_(n-1), directed so that its edges are the missing twins of the loop.
class LoopFiller {
 public:
  LoopFiller(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const std::vector<Index>& loop)
      : mesh_(mesh), points_(points), size_(static_cast<int>(loop.size())) {
    for (auto h = loop.rbegin(); h != loop.rend(); ++h) {
      polygon_.push_back(mesh.target(*h));
      beyond_.push_back(mesh.opposite(*h));
    }
    weight_.resize(static_cast<std::size_t>(size_ * size_));
    middle_.assign(static_cast<std::size_t>(size_ * size_), -1);
  }

  std::vector<Triangle> run() {
    for (int i = 0; i + 1 < size_; ++i) weight(i, i + 1) = {0, 0};
    for (int span = 2; span < size_; ++span) {
      for (int i = 0; i + span < size_; ++i) chooseMiddle(i, i + span);
    }
    std::vector<Triangle> triangles;
    if (size_ < 3 || weight(0, size_ - 1).bend > kWorstBend) return triangles;
    collect(0, size_ - 1, triangles);
    return triangles;
  }

 private:
  Weight& weight(int i, int j) { return weight_[static_cast<std::size_t>(i * size_ + j)]; }
  int& middle(int i, int j) { return middle_[static_cast<std::size_t>(i * size_ + j)]; }
  const Vec3& at(int i) const { return points_[polygon_[i]]; }

  bool isFree(int i, int j) const {
    const bool is_side = j - i == 1 || (i == 0 && j == size_ - 1);
    return is_side ||
           (mesh_.find(polygon_[i], polygon_[j]) == kNone && mesh_.find(polygon_[j], polygon_[i]) == kNone);
  }

  // Bend between a fill triangle of this normal and whatever lies beyond its side (i, j), i < j.
  double bendAcross(int i, int j, const Vec3& normal) {
    Vec3 other;
    if (j - i == 1) {
      other = unitNormal(at(j), at(i), points_[beyond_[i]]);
    } else {
      const int m = middle(i, j);
      other = unitNormal(at(i), at(m), at(j));
    }
    return std::atan2(other.cross(normal).norm(), other.dot(normal));
  }

  void chooseMiddle(int i, int j) {
    if (!isFree(i, j)) return;
    for (int m = i + 1; m < j; ++m) {
      const Vec3 area = (at(m) - at(i)).cross(at(j) - at(i));
      const double longest =
          std::max({(at(m) - at(i)).norm(), (at(j) - at(m)).norm(), (at(i) - at(j)).norm()});
      if (area.norm() <= kSliver * longest * longest) continue;
      const Weight& left = weight(i, m);
      const Weight& right = weight(m, j);
      if (std::isinf(left.bend) || std::isinf(right.bend)) continue;
      const Vec3 normal = area.normalized();
      Weight total;
      total.bend = std::max({left.bend, right.bend, bendAcross(i, m, normal), bendAcross(m, j, normal)});
      if (i == 0 && j == size_ - 1) total.bend = std::max(total.bend, bendOfLastSide(normal));
      total.area = left.area + right.area + 0.5 * area.norm();
      if (total < weight(i, j)) {
        weight(i, j) = total;
        middle(i, j) = m;
      }
    }
  }

  double bendOfLastSide(const Vec3& normal) const {
    const Vec3 other = unitNormal(at(0), at(size_ - 1), points_[beyond_[size_ - 1]]);
    return std::atan2(other.cross(normal).norm(), other.dot(normal));
  }

  void collect(int i, int j, std::vector<Triangle>& triangles) {
    if (j - i < 2) return;
    const int m = middle(i, j);
    triangles.push_back({polygon_[i], polygon_[m], polygon_[j]});
    collect(i, m, triangles);
    collect(m, j, triangles);
  }

  const HalfEdgeMesh& mesh_;
  const std::vector<Vec3>& points_;
  const int size_;
  std::vector<Index> polygon_;
  std::vector<Index> beyond_;  // opposite vertex of the triangle behind side i -> i + 1
  std::vector<Weight> weight_;
  std::vector<int> middle_;
};

bool isSmall(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const std::vector<Index>& loop,
             const FillLimits& limits) {
  if (static_cast<int>(loop.size()) > limits.max_edges) return false;
  double perimeter = 0;
  for (const Index h : loop) perimeter += (points[mesh.target(h)] - points[mesh.origin(h)]).norm();
  return perimeter <= limits.max_perimeter;
}

}  // namespace

std::vector<std::vector<Index>> simpleLoops(const HalfEdgeMesh& mesh, const std::vector<Index>& loop) {
  std::vector<std::vector<Index>> parts;
  std::vector<Index> open;
  for (const Index h : loop) {
    const auto seen =
        std::find_if(open.begin(), open.end(), [&](Index g) { return mesh.origin(g) == mesh.origin(h); });
    if (seen != open.end()) {
      parts.emplace_back(seen, open.end());
      open.erase(seen, open.end());
    }
    open.push_back(h);
  }
  if (!open.empty()) parts.push_back(std::move(open));
  return parts;
}

std::vector<Triangle> fillOf(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                             const std::vector<Index>& loop) {
  return LoopFiller(mesh, points, loop).run();
}

FillCount fillLoops(HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const FillLimits& limits) {
  constexpr int kSlack = 4;  // a loop may be longer than the limit before it is cut at repeated vertices
  FillCount count;
  for (const std::vector<Index>& walk : mesh.borderLoopEdges()) {
    if (static_cast<int>(walk.size()) > kSlack * limits.max_edges) continue;
    for (const std::vector<Index>& loop : simpleLoops(mesh, walk)) {
      if (!isSmall(mesh, points, loop, limits)) continue;
      const std::vector<Triangle> fill = fillOf(mesh, points, loop);
      for (const auto& [a, b, c] : fill) mesh.addTriangle(a, b, c);
      count.loops += fill.empty() ? 0 : 1;
      count.triangles += static_cast<Index>(fill.size());
    }
  }
  return count;
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - G. Barequet, M. Sharir, "Filling gaps in the boundary of a polyhedron", 1995: the triangulation of a loop
// by dynamic
//   programming.
// - P. Liepa, "Filling holes in meshes", SGP 2003: its weight, worst dihedral angle first, then area.
#include "polygon_fill.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr double kSliver = 1e-6;

struct Weight {
  double bend = std::numeric_limits<double>::infinity();
  double area = 0;

  bool operator<(const Weight& other) const {
    return bend < other.bend || (bend == other.bend && area < other.area);
  }
};

class PolygonFiller {
 public:
  PolygonFiller(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const FillPolygon& polygon,
                const FillRule& rule)
      : mesh_(mesh),
        points_(points),
        polygon_(polygon.vertex),
        beyond_(polygon.beyond),
        rule_(rule),
        size_(static_cast<int>(polygon.vertex.size())) {
    weight_.resize(cells());
    middle_.assign(cells(), -1);
  }

  std::vector<Triangle> run() {
    for (int i = 0; i + 1 < size_; ++i) weight(i, i + 1) = {0, 0};
    for (int span = 2; span < size_; ++span) {
      for (int i = 0; i + span < size_; ++i) chooseMiddle(i, i + span);
    }
    std::vector<Triangle> triangles;
    if (size_ < 3 || !(weight(0, size_ - 1).bend <= rule_.worst_bend)) return triangles;
    collect(0, size_ - 1, triangles);
    return triangles;
  }

 private:
  std::size_t cells() const { return static_cast<std::size_t>(size_) * static_cast<std::size_t>(size_); }
  std::size_t cell(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(j);
  }
  Weight& weight(int i, int j) { return weight_[cell(i, j)]; }
  int& middle(int i, int j) { return middle_[cell(i, j)]; }
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
      if (beyond_[i] == kNone) return 0;
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
      const bool sliver = area.norm() <= kSliver * longest * longest;
      if (sliver && !rule_.slivers) continue;
      const Weight& left = weight(i, m);
      const Weight& right = weight(m, j);
      if (std::isinf(left.bend) || std::isinf(right.bend)) continue;
      const Vec3 normal = sliver ? Vec3(Vec3::Zero()) : Vec3(area.normalized());
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
    if (beyond_[size_ - 1] == kNone) return 0;
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
  const std::vector<Index>& polygon_;
  const std::vector<Index>& beyond_;
  const FillRule rule_;
  const int size_;
  std::vector<Weight> weight_;
  std::vector<int> middle_;
};

}  // namespace

FillPolygon polygonOf(const HalfEdgeMesh& mesh, const std::vector<Index>& loop) {
  FillPolygon polygon;
  for (auto h = loop.rbegin(); h != loop.rend(); ++h) {
    polygon.vertex.push_back(mesh.target(*h));
    polygon.beyond.push_back(mesh.opposite(*h));
  }
  return polygon;
}

std::vector<Triangle> fillPolygon(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                                  const FillPolygon& polygon, const FillRule& rule) {
  return PolygonFiller(mesh, points, polygon, rule).run();
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
// This work is based on P. Liepa, "Filling holes in meshes", SGP 2003. Departure: his dynamic programming is
// cubic; a long loop is first filled between a hundred of its vertices, then what is left beside each side of
// that polygon. And where an edge that it needs is taken, or the loop is a triangle, a vertex in the middle
// takes its place.
#include "patch_outline.h"

#include "polygon_fill.h"

namespace mlsmesh::core {
namespace {

constexpr int kMostAtOnce = 100;  // vertices that dynamic programming is given

// The third vertex of the triangle that runs u -> v, or kNone.
Index apexOf(const std::vector<Triangle>& triangles, Index u, Index v) {
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      if (t[i] == u && t[(i + 1) % 3] == v) return t[(i + 2) % 3];
    }
  }
  return kNone;
}

class Outline {
 public:
  Outline(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points) : mesh_(mesh), points_(points) {}

  /// False where an edge that is needed is taken.
  bool fill(const FillPolygon& polygon) {
    const int size = static_cast<int>(polygon.vertex.size());
    if (size < 3) return true;
    if (size > kMostAtOnce) return fillCoarsely(polygon, size);
    const std::vector<Triangle> fill = fillPolygon(mesh_, points_, polygon, {3.15, true});
    triangles_.insert(triangles_.end(), fill.begin(), fill.end());
    return !fill.empty();
  }

  const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  bool fillCoarsely(const FillPolygon& polygon, int size) {
    std::vector<int> kept;
    for (int i = 0; i < kMostAtOnce; ++i)
      kept.push_back(static_cast<int>(static_cast<std::int64_t>(i) * size / kMostAtOnce));
    kept.push_back(size);
    FillPolygon coarse;
    for (int i = 0; i < kMostAtOnce; ++i) {
      const bool is_side = kept[i + 1] == kept[i] + 1;
      const Index from = polygon.vertex[kept[i]], to = polygon.vertex[kept[i + 1] % size];
      if (!is_side && (mesh_.find(from, to) != kNone || mesh_.find(to, from) != kNone)) return false;
      coarse.vertex.push_back(from);
      coarse.beyond.push_back(is_side ? polygon.beyond[kept[i]] : kNone);
    }
    const std::vector<Triangle> fill = fillPolygon(mesh_, points_, coarse, {3.15, true});
    if (fill.empty()) return false;
    triangles_.insert(triangles_.end(), fill.begin(), fill.end());
    for (int i = 0; i < kMostAtOnce; ++i) {
      if (!this->fill(besideSide(polygon, kept[i], kept[i + 1], fill))) return false;
    }
    return true;
  }

  // What lies between a side of the coarse polygon and the vertices first .. last that it passes over.
  static FillPolygon besideSide(const FillPolygon& polygon, int first, int last,
                                const std::vector<Triangle>& coarse) {
    FillPolygon rest;
    const int size = static_cast<int>(polygon.vertex.size());
    for (int i = first; i <= last; ++i) {
      rest.vertex.push_back(polygon.vertex[i % size]);
      rest.beyond.push_back(polygon.beyond[i % size]);
    }
    rest.beyond.back() = apexOf(coarse, rest.vertex.front(), rest.vertex.back());
    return rest;
  }

  const HalfEdgeMesh& mesh_;
  const std::vector<Vec3>& points_;
  std::vector<Triangle> triangles_;
};

bool addAll(const std::vector<Triangle>& triangles, HalfEdgeMesh& mesh) {
  std::vector<Index> added;
  for (const auto& [a, b, c] : triangles) {
    const Index t = mesh.addTriangle(a, b, c);
    if (t == kNone) {
      for (const Index other : added) mesh.removeTriangle(other);
      return false;
    }
    added.push_back(t);
  }
  return true;
}

void addAround(const FillPolygon& polygon, HalfEdgeMesh& mesh, std::vector<Vec3>& points) {
  Vec3 middle = Vec3::Zero();
  for (const Index v : polygon.vertex) middle += points[v];
  points.push_back(middle / static_cast<double>(polygon.vertex.size()));
  const Index center = mesh.addVertex();
  for (std::size_t i = 0; i < polygon.vertex.size(); ++i) {
    mesh.addTriangle(polygon.vertex[i], polygon.vertex[(i + 1) % polygon.vertex.size()], center);
  }
}

}  // namespace

void outlinePatch(HalfEdgeMesh& mesh, std::vector<Vec3>& points, const std::vector<Index>& loop) {
  const FillPolygon polygon = polygonOf(mesh, loop);
  Outline outline(mesh, points);
  const bool filled = loop.size() > 3 && outline.fill(polygon) && addAll(outline.triangles(), mesh);
  if (!filled) addAround(polygon, mesh, points);
}

}  // namespace mlsmesh::core

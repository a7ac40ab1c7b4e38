// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "mlsmesh/core/types.h"

// Meshes and clouds whose properties are known beforehand.
namespace mlsmesh::test {

struct Soup {
  std::vector<core::Vec3> vertices;
  std::vector<core::Triangle> triangles;

  core::Index vertexCount() const { return static_cast<core::Index>(vertices.size()); }
};

/// Closed, genus 0, oriented outward.
inline Soup octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// Closed, genus 0, oriented outward.
inline Soup tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// columns x rows quads of two triangles each; where the grid is wrapped, its last line of vertices is its
/// first. `twist` turns the seam of wrapped columns over. Vertices (column, row) have index column * lines +
/// row.
struct GridOptions {
  bool wrap_columns = false;
  bool wrap_rows = false;
  bool twist = false;
};

inline Soup grid(core::Index columns, core::Index rows, const GridOptions& options = {}) {
  const core::Index across = options.wrap_columns ? columns : columns + 1;
  const core::Index lines = options.wrap_rows ? rows : rows + 1;
  const auto vertex = [&](core::Index column, core::Index row) {
    const bool seam = column == across;
    const core::Index wrapped = row % lines;
    return seam ? (options.twist ? lines - 1 - wrapped : wrapped) : column * lines + wrapped;
  };
  Soup soup;
  for (core::Index c = 0; c < across; ++c)
    for (core::Index r = 0; r < lines; ++r)
      soup.vertices.emplace_back(std::cos(0.5 * c) * (3 + 0.3 * r), std::sin(0.5 * c) * (3 + 0.2 * r),
                                 0.1 * r * r + c);
  for (core::Index c = 0; c < columns; ++c) {
    for (core::Index r = 0; r < rows; ++r) {
      const core::Index a = vertex(c, r), b = vertex(c + 1, r), d = vertex(c, r + 1),
                        e = vertex(c + 1, r + 1);
      soup.triangles.push_back({a, b, e});
      soup.triangles.push_back({a, e, d});
    }
  }
  return soup;
}

inline Soup torus(core::Index columns, core::Index rows) {
  return grid(columns, rows, {true, true, false});
}
inline Soup openCylinder(core::Index columns, core::Index rows) {
  return grid(columns, rows, {true, false, false});
}
inline Soup moebiusBand(core::Index columns) {
  return grid(columns, 1, {true, false, true});
}

/// Both soups as one; no vertex is shared.
inline Soup together(const Soup& a, const Soup& b) {
  Soup both = a;
  both.vertices.insert(both.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (core::Triangle t : b.triangles) {
    for (core::Index& corner : t) corner += a.vertexCount();
    both.triangles.push_back(t);
  }
  return both;
}

/// Rounded to floats; through memory, because GCC 12 takes a pair of vectorised conversions there and back
/// for nothing.
inline core::Vec3 asFloats(const core::Vec3& point) {
  volatile float rounded[3];
  for (int axis = 0; axis < 3; ++axis) rounded[axis] = static_cast<float>(point[axis]);
  return core::Vec3(rounded[0], rounded[1], rounded[2]);
}

inline std::vector<core::Vec3> randomCloud(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(-1, 1);
  std::vector<core::Vec3> points(count);
  for (core::Vec3& point : points)
    for (int axis = 0; axis < 3; ++axis) point[axis] = static_cast<double>(coordinate(random));
  return points;
}

inline std::vector<core::Vec3> lattice(int side) {
  std::vector<core::Vec3> points;
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z) points.emplace_back(x, y, z);
  return points;
}

}  // namespace mlsmesh::test

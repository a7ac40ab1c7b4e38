// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_welding.h"

#include <algorithm>
#include <numeric>

namespace mlsmesh {

using core::Index;
using core::Vec3;

namespace {

/// A total order, but for 0 and -0.
bool comesBefore(const Vec3& a, const Vec3& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis] != b[axis]) return a[axis] < b[axis];
  return false;
}

}  // namespace

std::vector<Index> firstAtSamePosition(const std::vector<Vec3>& positions) {
  std::vector<Index> first(positions.size()), order;
  std::iota(first.begin(), first.end(), 0);
  order.reserve(positions.size());
  for (const Index i : first)
    if (positions[i].allFinite()) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const Vec3 &p = positions[a], &q = positions[b];
    return comesBefore(p, q) || (a < b && !comesBefore(q, p));
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (positions[order[i]] == positions[order[i - 1]]) first[order[i]] = first[order[i - 1]];
  }
  return first;
}

Index weldVertices(std::vector<Vec3>& vertices, std::vector<core::Triangle>& triangles) {
  std::vector<Index> name = firstAtSamePosition(vertices);
  Index kept = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const bool is_first = name[v] == static_cast<Index>(v);
    if (is_first) vertices[kept] = vertices[v];
    name[v] = is_first ? kept++ : name[name[v]];
  }
  const Index merged = static_cast<Index>(vertices.size()) - kept;
  vertices.resize(static_cast<std::size_t>(kept));
  for (core::Triangle& triangle : triangles)
    for (Index& corner : triangle) corner = name[corner];
  return merged;
}

}  // namespace mlsmesh

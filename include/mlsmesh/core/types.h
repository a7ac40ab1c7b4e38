// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

namespace mlsmesh::core {

using Vec3 = Eigen::Vector3d;
/// Names a point, vertex, triangle or half-edge; kNone is no such thing.
using Index = std::int32_t;
constexpr Index kNone = -1;
using Triangle = std::array<Index, 3>;

/// Lists of indices of varying length in one flat array: list i is items[begin[i] .. begin[i + 1]).
struct IndexLists {
  std::vector<Index> begin{0};
  std::vector<Index> items;

  Index count() const { return static_cast<Index>(begin.size()) - 1; }
  Index size(Index list) const { return begin[list + 1] - begin[list]; }
  const Index* data(Index list) const { return items.data() + begin[list]; }
  void append(const Index* list, Index size) {
    items.insert(items.end(), list, list + size);
    begin.push_back(static_cast<Index>(items.size()));
  }
};

}  // namespace mlsmesh::core

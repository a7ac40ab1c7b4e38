// SPDX-License-Identifier: BSD-3-Clause
#include "edge_table.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "mlsmesh/core/failure.h"

namespace mlsmesh {

using core::Index;
using core::Triangle;

bool hasThreeCorners(const Triangle& face, Index vertices) {
  const auto [low, high] = std::minmax_element(face.begin(), face.end());
  return *low >= 0 && *high < vertices && face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

std::vector<Triangle> facesWithThreeCorners(const std::vector<Triangle>& faces, Index vertices) {
  std::vector<Triangle> kept;
  kept.reserve(faces.size());
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(kept),
               [&](const Triangle& face) { return hasThreeCorners(face, vertices); });
  return kept;
}

EdgeTable::EdgeTable(Index vertices, std::vector<Triangle> faces)
    : vertices_(vertices), faces_(std::move(faces)) {
  if (faces_.size() > std::numeric_limits<Index>::max() / 3)
    throw core::Failure(StatusCode::IndexOverflow,
                        "the mesh has more half-edges than 32-bit indices can name");
  sortHalfEdges();
}

Index EdgeTable::low(Index half_edge) const {
  return std::min(origin(half_edge), target(half_edge));
}

Index EdgeTable::high(Index half_edge) const {
  return std::max(origin(half_edge), target(half_edge));
}

// Counted into one bucket per lower end, each bucket then sorted by (higher end, half-edge).
void EdgeTable::sortHalfEdges() {
  using Item = std::pair<Index, Index>;
  std::vector<Index> bucket(static_cast<std::size_t>(vertices_) + 1, 0);
  for (Index h = 0; h < halfEdgeCount(); ++h) ++bucket[low(h) + 1];
  std::partial_sum(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<Item> items(static_cast<std::size_t>(halfEdgeCount()));
  std::vector<Index> place(bucket.begin(), bucket.end() - 1);
  for (Index h = 0; h < halfEdgeCount(); ++h) items[place[low(h)]++] = {high(h), h};
  sorted_.resize(items.size());
  for (Index v = 0; v < vertices_; ++v) {
    std::sort(items.begin() + bucket[v], items.begin() + bucket[v + 1]);
    for (Index i = bucket[v]; i < bucket[v + 1]; ++i) {
      sorted_[i] = items[i].second;
      if (i == bucket[v] || items[i].first != items[i - 1].first) begin_.push_back(i);
    }
  }
  begin_.push_back(halfEdgeCount());
}

}  // namespace mlsmesh

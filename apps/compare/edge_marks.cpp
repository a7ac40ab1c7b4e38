// SPDX-License-Identifier: BSD-3-Clause
#include "compare/edge_marks.h"

#include <algorithm>
#include <tuple>

namespace mlsmesh::apps {
namespace {

/// A side of a triangle.
struct Side {
  EdgeMarks::Edge edge;  ///< the lower vertex first
  bool upwards;          ///< from the lower to the higher one
};

std::vector<Side> sortedSides(const std::vector<core::Triangle>& triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (const auto& [a, b, c] : triangles) {
    if (a == b || b == c || c == a) continue;
    for (const auto& [from, to] : {EdgeMarks::Edge{a, b}, EdgeMarks::Edge{b, c}, EdgeMarks::Edge{c, a}})
      sides.push_back({{std::min(from, to), std::max(from, to)}, from < to});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& left, const Side& right) {
    return std::tie(left.edge, left.upwards) < std::tie(right.edge, right.upwards);
  });
  return sides;
}

}  // namespace

EdgeMarks markEdges(const std::vector<core::Triangle>& triangles) {
  const std::vector<Side> sides = sortedSides(triangles);
  EdgeMarks marks;
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].edge == sides[first].edge) ++last;
    if (last - first == 1)
      marks.border.push_back(sides[first].edge);
    else if (last - first > 2)
      marks.nonmanifold.push_back(sides[first].edge);
    else if (sides[first].upwards == sides[first + 1].upwards)
      marks.misoriented.push_back(sides[first].edge);
  }
  return marks;
}

}  // namespace mlsmesh::apps

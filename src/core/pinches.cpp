// SPDX-License-Identifier: BSD-3-Clause
#include "pinches.h"

#include <algorithm>
#include <set>
#include <utility>

namespace mlsmesh::core {
namespace {

bool isLarger(const std::vector<Index>& a, const std::vector<Index>& b) {
  if (a.size() != b.size()) return a.size() > b.size();
  return *std::min_element(a.begin(), a.end()) < *std::min_element(b.begin(), b.end());
}

// Drops all fans but the largest that have at most `limit` triangles; tells which vertices lost one.
Index dropFans(HalfEdgeMesh& mesh, Index vertex, std::size_t limit, std::set<Index>& touched) {
  std::vector<std::vector<Index>> fans = mesh.fans(vertex);
  if (fans.size() < 2) return 0;
  std::stable_sort(fans.begin(), fans.end(), isLarger);
  Index dropped = 0;
  for (std::size_t i = 1; i < fans.size(); ++i) {
    if (fans[i].size() > limit) continue;
    for (const Index h : fans[i]) {
      const Index triangle = HalfEdgeMesh::triangleOf(h);
      if (!mesh.alive(triangle)) continue;
      for (const Index corner : mesh.corners(triangle)) touched.insert(corner);
      mesh.removeTriangle(triangle);
      ++dropped;
    }
  }
  return dropped;
}

struct Dropped {
  Index triangles = 0;
  std::set<Index> looked_at;  // vertices that are or were pinched, or lost triangles
};

Dropped dropAll(HalfEdgeMesh& mesh, std::size_t limit, const Context& context) {
  CancelCheck check(context);
  Dropped dropped;
  std::set<Index> pinched;
  for (Index v = 0; v < mesh.vertexCount(); ++v) {
    check();
    if (mesh.isUsed(v) && mesh.fanCount(v) > 1) pinched.insert(v);
  }
  while (!pinched.empty()) {
    std::set<Index> touched;
    for (const Index v : pinched) dropped.triangles += dropFans(mesh, v, limit, touched);
    dropped.looked_at.insert(pinched.begin(), pinched.end());
    pinched = std::move(touched);
  }
  return dropped;
}

}  // namespace

PinchCount resolvePinches(HalfEdgeMesh& mesh, Index largest_dropped, std::vector<Index>* duplicate_of,
                          const Context& context) {
  PinchCount count;
  const auto limit = static_cast<std::size_t>(largest_dropped);
  const Dropped dropped =
      dropAll(mesh, duplicate_of ? limit : static_cast<std::size_t>(mesh.slotCount()), context);
  count.dropped_triangles = dropped.triangles;
  if (!duplicate_of) return count;
  for (const Index v : dropped.looked_at) {
    if (!mesh.isUsed(v) || mesh.fanCount(v) < 2) continue;
    for (std::size_t i = mesh.splitFans(v).size(); i > 0; --i) {
      duplicate_of->push_back(v);
      ++count.split_vertices;
    }
  }
  return count;
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
#include "local_repair.h"

#include <algorithm>

#include "border_fill.h"

namespace mlsmesh::core {
namespace {

constexpr std::size_t kMostEdges = 60;     // of a loop that is filled: the work grows with their cube
constexpr std::int64_t kMostWalked = 400;  // edges of border loops, a triangle

std::vector<Index> bordersAt(const HalfEdgeMesh& mesh, const std::vector<Index>& vertices) {
  std::vector<Index> borders;
  for (const Index v : vertices) {
    for (Index h = mesh.firstOutgoing(v); h != kNone; h = mesh.nextOutgoing(h)) {
      if (mesh.isBorder(h)) borders.push_back(h);
    }
  }
  return borders;
}

}  // namespace

Region distinct(Region region) {
  std::sort(region.begin(), region.end());
  region.erase(std::unique(region.begin(), region.end()), region.end());
  return region;
}

Region grown(const HalfEdgeMesh& mesh, const Region& region) {
  Region larger;
  for (const Index v : verticesOf(mesh, region)) {
    for (Index h = mesh.firstOutgoing(v); h != kNone; h = mesh.nextOutgoing(h))
      larger.push_back(HalfEdgeMesh::triangleOf(h));
  }
  return distinct(std::move(larger));
}

std::vector<Index> verticesOf(const HalfEdgeMesh& mesh, const Region& region) {
  std::vector<Index> vertices;
  for (const Index t : region) {
    for (const Index v : mesh.corners(t)) vertices.push_back(v);
  }
  return distinct(std::move(vertices));
}

bool LocalRepair::isSpent() const {
  return walked_ > kMostWalked * surgery_.mesh().slotCount();
}

// The loops that the border half-edges lie on, each once, from the first of them that lies on it.
LocalRepair::Loops LocalRepair::loopsOf(const std::vector<Index>& half_edges) {
  const HalfEdgeMesh& mesh = surgery_.mesh();
  const Region waiting = distinct(half_edges);
  std::vector<char> done(waiting.size(), 0);
  const auto placeOf = [&](Index h) { return std::lower_bound(waiting.begin(), waiting.end(), h); };
  Loops loops;
  for (const Index start : half_edges) {
    if (done[placeOf(start) - waiting.begin()] != 0) continue;
    std::vector<Index>& loop = loops.emplace_back();
    Index h = start;
    do {
      loop.push_back(h);
      const auto place = placeOf(h);
      if (place != waiting.end() && *place == h) done[place - waiting.begin()] = 1;
      h = mesh.nextBorder(h);
    } while (h != start);
    walked_ += static_cast<std::int64_t>(loop.size());
  }
  return loops;
}

LocalTopology LocalRepair::topologyAt(const std::vector<Index>& vertices) {
  return {surgery_.pairs().size(), loopsOf(bordersAt(surgery_.mesh(), vertices)).size(), surgery_.euler()};
}

Index LocalRepair::componentCount() const {
  Index count = 0;
  surgery_.mesh().components(&count, surgery_.context());
  return count;
}

bool LocalRepair::isPinched(const std::vector<Index>& vertices) const {
  return std::any_of(vertices.begin(), vertices.end(),
                     [&](Index v) { return surgery_.mesh().fanCount(v) > 1; });
}

bool LocalRepair::attempt(const std::vector<Index>& vertices, const Change& change, const Helps& helps) {
  if (isSpent()) return false;
  const std::size_t mark = surgery_.mark();
  const LocalTopology before = topologyAt(vertices);
  if (components_ == kNone) components_ = componentCount();
  if (change() && !isPinched(vertices)) {
    const LocalTopology after = topologyAt(vertices);
    const Index gain = after.closedness() - before.closedness();
    const bool harmless = after.pairs <= before.pairs && after.loops <= before.loops && gain >= 0;
    if (harmless && helps(before, after) && (gain == 0 || componentCount() <= components_)) return true;
  }
  surgery_.undo(mark);
  return false;
}

bool LocalRepair::renew(const Region& region) {
  const HalfEdgeMesh& mesh = surgery_.mesh();
  const bool had_border = std::any_of(region.begin(), region.end(), [&](Index t) {
    return mesh.isBorder(3 * t) || mesh.isBorder(3 * t + 1) || mesh.isBorder(3 * t + 2);
  });
  const std::size_t mark = surgery_.mark();
  surgery_.remove(region);
  const std::vector<Index> opened = surgery_.openedSince(mark);
  Loops loops = loopsOf(opened);
  const auto wasOpen = std::stable_partition(loops.begin(), loops.end(), [&](const std::vector<Index>& loop) {
    return std::all_of(loop.begin(), loop.end(),
                       [&](Index h) { return std::binary_search(opened.begin(), opened.end(), h); });
  });
  const bool lost_border = had_border && wasOpen == loops.end();
  loops.erase(wasOpen, loops.end());
  if (lost_border && !loops.empty()) {  // the whole border went: the longest loop is now in its place
    loops.erase(std::max_element(loops.begin(), loops.end(),
                                 [](const auto& x, const auto& y) { return x.size() < y.size(); }));
  }
  return std::all_of(loops.begin(), loops.end(), [&](const auto& loop) { return close(loop); });
}

bool LocalRepair::close(const std::vector<Index>& loop) {
  for (const std::vector<Index>& part : simpleLoops(surgery_.mesh(), loop)) {
    if (part.size() > kMostEdges) return false;
    const std::vector<Triangle> fill = fillOf(surgery_.mesh(), surgery_.points(), part);
    if (fill.empty() || !surgery_.add(fill)) return false;
  }
  return true;
}

void LocalRepair::open(Region region) {
  while (!region.empty()) {
    const std::vector<Index> touched = verticesOf(surgery_.mesh(), region);
    surgery_.remove(region);
    region = smallerFans(touched);
  }
  components_ = kNone;
}

Region LocalRepair::smallerFans(const std::vector<Index>& vertices) const {
  Region region;
  for (const Index v : vertices) {
    std::vector<std::vector<Index>> fans = surgery_.mesh().fans(v);
    if (fans.size() < 2) continue;
    std::stable_sort(fans.begin(), fans.end(),
                     [](const auto& a, const auto& b) { return a.size() > b.size(); });
    for (std::size_t i = 1; i < fans.size(); ++i) {
      for (const Index h : fans[i]) region.push_back(HalfEdgeMesh::triangleOf(h));
    }
  }
  return distinct(std::move(region));
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
#include "intersection_guard.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "disjoint_sets.h"
#include "mlsmesh/core/self_intersections.h"
#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr char kOnMidpoint = 3;  // stages of a pulled vertex: 1/2, 1/4, 0 of its displacement

// Triangles that flips have mixed with one another; taking back all flips of a group is always possible,
// unless one of its edges has come into being elsewhere.
class FlipGroups {
 public:
  FlipGroups(Index triangles, const std::vector<FlippedPair>& flips)
      : groups_(static_cast<std::size_t>(triangles)), restored_(triangles) {
    for (const auto& [a, b] : flips) groups_.join(a, b);
    for (const auto& [a, b] : flips) {
      members_.push_back({groups_.leader(a), a});
      members_.push_back({groups_.leader(b), b});
    }
    std::sort(members_.begin(), members_.end());
    members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
  }

  /// Whether the triangle is one of those that flips made and restore() has not taken back.
  bool isFlipped(Index triangle) {
    const Index leader = groups_.leader(triangle);
    const auto first = firstMember(leader);
    return first != members_.end() && first->leader == leader && restored_[leader] == 0;
  }
  /// Notes the triangle's group as restored and returns its members.
  std::vector<Index> restore(Index triangle) {
    const Index leader = groups_.leader(triangle);
    restored_[leader] = 1;
    std::vector<Index> group;
    for (auto m = firstMember(leader); m != members_.end() && m->leader == leader; ++m)
      group.push_back(m->triangle);
    return group;
  }

 private:
  struct Member {
    Index leader, triangle;

    bool operator<(const Member& other) const {
      return leader != other.leader ? leader < other.leader : triangle < other.triangle;
    }
    bool operator==(const Member& other) const {
      return leader == other.leader && triangle == other.triangle;
    }
  };

  std::vector<Member>::const_iterator firstMember(Index leader) const {
    return std::lower_bound(members_.begin(), members_.end(), Member{leader, 0});
  }

  DisjointSets groups_;
  std::vector<char> restored_;
  std::vector<Member> members_;
};

// The unflipped triangles at every vertex of the level's own.
IndexLists trianglesAtNewVertices(const NewLevel& level) {
  IndexLists lists;
  lists.begin.assign(level.midpoint.size() + 2, 0);
  for (const Triangle& t : level.unflipped) {
    for (const Index v : t) {
      if (v >= level.first_vertex) ++lists.begin[v - level.first_vertex + 2];
    }
  }
  std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
  lists.items.resize(static_cast<std::size_t>(lists.begin.back()));
  for (std::size_t t = 0; t < level.unflipped.size(); ++t) {
    for (const Index v : level.unflipped[t]) {
      if (v >= level.first_vertex)
        lists.items[lists.begin[v - level.first_vertex + 1]++] = static_cast<Index>(t);
    }
  }
  lists.begin.pop_back();
  return lists;
}

class Guard {
 public:
  Guard(const PointSet& points, const NewLevel& level, RefinedMesh& refined, std::vector<Triangle>& triangles)
      : points_(points),
        level_(level),
        refined_(refined),
        triangles_(triangles),
        groups_(static_cast<Index>(triangles.size()), level.flips),
        around_(trianglesAtNewVertices(level)),
        stage_(level.midpoint.size(), 0) {}

  /// Takes back one thing of each triangle in a pair; returns the triangles that changed, none if all is
  /// already the parent's.
  std::vector<Index> takeBack(const std::vector<TrianglePair>& pairs) {
    changed_.clear();
    std::set<Index> to_restore, to_pull;
    for (const TrianglePair& pair : pairs) {
      bool flipped = false;
      for (const Index t : pair) {
        if (!groups_.isFlipped(t)) continue;
        to_restore.insert(t);
        flipped = true;
      }
      if (!flipped) noteNewVertices(pair, to_pull);
    }
    for (const Index t : to_restore) restore(t);
    for (const Index v : to_pull) pull(v);
    return {changed_.begin(), changed_.end()};
  }

 private:
  void noteNewVertices(const TrianglePair& pair, std::set<Index>& vertices) const {
    for (const Index t : pair) {
      for (const Index v : triangles_[t]) {
        if (v >= level_.first_vertex) vertices.insert(v);
      }
    }
  }

  // Takes back the flips of the triangle's group, and of those whose edges its own would double.
  void restore(Index triangle) {
    std::vector<Index> waiting = {triangle};
    while (!waiting.empty()) {
      const Index next = waiting.back();
      waiting.pop_back();
      if (!groups_.isFlipped(next)) continue;
      for (const Index t : groups_.restore(next)) {
        triangles_[t] = level_.unflipped[t];
        changed_.insert(t);
        for (int i = 0; i < 3; ++i) {
          const Index h = level_.flipped.find(triangles_[t][i], triangles_[t][(i + 1) % 3]);
          if (h != kNone) waiting.push_back(HalfEdgeMesh::triangleOf(h));
        }
      }
    }
  }

  void pull(Index vertex) {
    const Index own = vertex - level_.first_vertex;
    Vec3& position = refined_.position[vertex];
    const Vec3 before = position, &midpoint = level_.midpoint[own];
    while (stage_[own] < kOnMidpoint) {
      ++stage_[own];
      position =
          stage_[own] == kOnMidpoint ? midpoint : points_.stored(midpoint + 0.5 * (position - midpoint));
      if (position != before && !degenerates(own)) break;
    }
    if (position == before || degenerates(own)) {
      position = before;
      return;
    }
    refined_.kind[vertex] = VertexKind::FoldGuarded;
    for (Index i = 0; i < around_.size(own); ++i) {
      restore(around_.data(own)[i]);
      changed_.insert(around_.data(own)[i]);
    }
  }

  bool degenerates(Index own) const {
    const Index* first = around_.data(own);
    return std::any_of(first, first + around_.size(own), [&](Index t) {
      const auto [a, b, c] = level_.unflipped[t];
      return isDegenerate(refined_.position[a], refined_.position[b], refined_.position[c]);
    });
  }

  const PointSet& points_;
  const NewLevel& level_;
  RefinedMesh& refined_;
  std::vector<Triangle>& triangles_;
  FlipGroups groups_;
  IndexLists around_;
  std::vector<char> stage_;
  std::set<Index> changed_;
};

// The pairs that still stand after triangles (ascending) have changed.
std::vector<TrianglePair> pairsAfter(const std::vector<TrianglePair>& pairs,
                                     const std::vector<Index>& changed, SelfIntersections& search) {
  search.update(changed);
  std::vector<TrianglePair> after = search.involving(changed);
  const auto isChanged = [&](Index t) { return std::binary_search(changed.begin(), changed.end(), t); };
  std::copy_if(pairs.begin(), pairs.end(), std::back_inserter(after),
               [&](const TrianglePair& pair) { return !isChanged(pair[0]) && !isChanged(pair[1]); });
  std::sort(after.begin(), after.end());
  return after;
}

}  // namespace

std::vector<TrianglePair> guardIntersections(const PointSet& points, const NewLevel& level,
                                             const Context& context, RefinedMesh& refined,
                                             std::vector<Triangle>& triangles) {
  SelfIntersections search(refined.position, triangles, context, &level.flipped);
  std::vector<TrianglePair> pairs = search.all();
  if (pairs.empty()) return pairs;
  Guard guard(points, level, refined, triangles);
  while (!pairs.empty()) {
    context.checkCancelled();
    const std::vector<Index> changed = guard.takeBack(pairs);
    if (changed.empty()) break;
    pairs = pairsAfter(pairs, changed, search);
  }
  return pairs;
}

}  // namespace mlsmesh::core

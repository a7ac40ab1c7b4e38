// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - D. Eppstein, "Dynamic generators of topologically embedded graphs", SODA 2003, and J. Erickson, K.
//   Whittlesey, "Greedy optimal homotopy and homology generators", SODA 2005: a spanning tree of the edges
//   and one of the dual edges that it leaves; the edges in neither close the cycles of all handles.
// - O. Busaryev, T. K. Dey, Y. Wang, "Minimum homology basis", 2012 (annotations): each edge carries the dual
//   cycles that it crosses, so that a walk divides its surface exactly if what it crosses cancels out.
// - I. Guskov, Z. Wood, "Topological noise removal", 2001: false handles are found by growing small regions.
#include "handle_loops.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>

namespace mlsmesh::core {
namespace {

using Mask = std::uint64_t;  // the sum of random words, one for each cycle that is crossed

Mask wordOf(std::size_t number) {
  Mask x = (number + 1) * 0x9E3779B97F4A7C15ULL;  // splitmix64
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ x >> 27) * 0x94D049BB133111EBULL;
  return x ^ x >> 31;
}

// What every edge of a mesh crosses, on both of its half-edges.
class Annotations {
 public:
  Annotations(const HalfEdgeMesh& mesh, const Context& context)
      : mesh_(mesh), context_(context), mask_(halfEdges(), 0), in_tree_(halfEdges()) {
    spanVertices();
    numberCaps();
    spanFaces();
    annotate();
  }

  Mask operator[](Index half_edge) const { return mask_[half_edge]; }
  bool isAnnotated() const { return annotated_; }

 private:
  std::size_t halfEdges() const { return 3 * static_cast<std::size_t>(mesh_.slotCount()); }
  bool isLive(Index h) const { return mesh_.alive(HalfEdgeMesh::triangleOf(h)); }

  void spanVertices() {
    CancelCheck check(context_);
    std::vector<char> seen(static_cast<std::size_t>(mesh_.vertexCount()), 0);
    std::vector<Index> queue;
    for (Index start = 0; start < mesh_.vertexCount(); ++start) {
      check();
      if (seen[start] || !mesh_.isUsed(start)) continue;
      seen[start] = 1;
      queue.assign(1, start);
      for (std::size_t next = 0; next < queue.size(); ++next) {
        check();
        const auto visit = [&](Index h, Index other) {
          if (seen[other]) return;
          seen[other] = 1;
          mark(h);
          queue.push_back(other);
        };
        for (Index h = mesh_.firstOutgoing(queue[next]); h != kNone; h = mesh_.nextOutgoing(h)) {
          visit(h, mesh_.target(h));
          visit(HalfEdgeMesh::previous(h), mesh_.opposite(h));
        }
      }
    }
  }

  void mark(Index h) {
    in_tree_[h] = 1;
    if (!mesh_.isBorder(h)) in_tree_[mesh_.twin(h)] = 1;
  }

  // Faces are the triangles and, from slotCount on, a cap over every border loop.
  void numberCaps() {
    cap_.assign(halfEdges(), kNone);
    loops_ = mesh_.borderLoopEdges(context_);
    for (std::size_t i = 0; i < loops_.size(); ++i) {
      for (const Index h : loops_[i]) cap_[h] = mesh_.slotCount() + static_cast<Index>(i);
    }
  }

  Index beyond(Index h) const {
    return mesh_.isBorder(h) ? cap_[h] : HalfEdgeMesh::triangleOf(mesh_.twin(h));
  }

  template <typename Visit>
  void eachSide(Index face, const Visit& visit) const {
    if (face < mesh_.slotCount()) {
      for (Index h = 3 * face; h < 3 * face + 3; ++h) visit(h, beyond(h));
    } else {
      for (const Index h : loops_[static_cast<std::size_t>(face - mesh_.slotCount())])
        visit(h, HalfEdgeMesh::triangleOf(h));
    }
  }

  // Breadth first, so that paths to the root are short.
  void spanFaces() {
    CancelCheck check(context_);
    const std::size_t faces = static_cast<std::size_t>(mesh_.slotCount()) + loops_.size();
    parent_.assign(faces, kNone);
    across_.assign(faces, kNone);
    std::vector<char> seen(faces, 0);
    std::vector<Index> queue;
    for (Index start = 0; start < static_cast<Index>(faces); ++start) {
      if (seen[start] || (start < mesh_.slotCount() && !mesh_.alive(start))) continue;
      seen[start] = 1;
      queue.assign(1, start);
      for (std::size_t next = 0; next < queue.size(); ++next) {
        check();
        const Index face = queue[next];
        eachSide(face, [&](Index h, Index other) {
          if (in_tree_[h] || seen[other]) return;
          seen[other] = 1;
          parent_[other] = face;
          across_[other] = h;
          queue.push_back(other);
        });
      }
    }
  }

  void cross(Index h, Mask word) {
    mask_[h] ^= word;
    if (!mesh_.isBorder(h)) mask_[mesh_.twin(h)] ^= word;
  }

  // An edge in neither tree closes a dual cycle with the paths of its two faces.
  void annotate() {
    CancelCheck check(context_);
    std::size_t number = 0;
    for (Index h = 0; h < static_cast<Index>(halfEdges()); ++h) {
      check();
      if (!isLive(h) || in_tree_[h] || (!mesh_.isBorder(h) && mesh_.twin(h) < h)) continue;
      const Index face = HalfEdgeMesh::triangleOf(h), other = beyond(h);
      if (isAcross(face, h) || isAcross(other, h)) continue;
      const Mask word = wordOf(number++);
      cross(h, word);
      for (Index f : {face, other}) {
        for (; parent_[f] != kNone; f = parent_[f]) {
          check();
          cross(across_[f], word);
        }
      }
      annotated_ = true;
    }
  }

  bool isAcross(Index face, Index h) const {
    return across_[face] != kNone &&
           (across_[face] == h || (!mesh_.isBorder(h) && across_[face] == mesh_.twin(h)));
  }

  const HalfEdgeMesh& mesh_;
  const Context& context_;
  std::vector<Mask> mask_;
  std::vector<char> in_tree_;
  std::vector<std::vector<Index>> loops_;
  std::vector<Index> cap_;     // of border half-edges
  std::vector<Index> parent_;  // of faces
  std::vector<Index> across_;  // half-edge between a face and its parent
  bool annotated_ = false;
};

struct Walk {
  std::vector<Index> vertices;
  double length = 0;
};

// The shortest walk that does not divide the surface, through one vertex.
class WalkFinder {
 public:
  WalkFinder(const HalfEdgeMesh& mesh, const Annotations& annotations, int max_edges)
      : mesh_(mesh), annotations_(annotations), max_edges_(max_edges) {}

  std::vector<Index> through(Index vertex) {
    reached_.clear();
    order_.assign(1, vertex);
    reached_[vertex] = {kNone, 0, 0};
    Index best_a = kNone, best_b = kNone;
    int best = max_edges_ + 1;
    for (std::size_t next = 0; next < order_.size(); ++next) {
      const Index v = order_[next];
      const Reached from = reached_[v];
      if (2 * from.depth >= best) break;
      eachEdge(v, [&](Index h, Index w) {
        const auto [place, is_new] =
            reached_.try_emplace(w, Reached{v, from.depth + 1, from.mask ^ annotations_[h]});
        if (is_new) {
          order_.push_back(w);
          return;
        }
        const Reached& to = place->second;
        const int edges = from.depth + to.depth + 1;
        if (edges >= best || (from.mask ^ to.mask ^ annotations_[h]) == 0) return;
        best = edges;
        best_a = v;
        best_b = w;
      });
    }
    return best_a == kNone ? std::vector<Index>() : walk(best_a, best_b);
  }

 private:
  struct Reached {
    Index from;
    int depth;
    Mask mask;
  };

  template <typename Visit>
  void eachEdge(Index v, const Visit& visit) const {
    for (Index h = mesh_.firstOutgoing(v); h != kNone; h = mesh_.nextOutgoing(h)) {
      visit(h, mesh_.target(h));
      const Index incoming = HalfEdgeMesh::previous(h);
      if (mesh_.isBorder(incoming)) visit(incoming, mesh_.opposite(h));
    }
  }

  // The two paths to the start, without what they share.
  std::vector<Index> walk(Index a, Index b) const {
    std::vector<Index> up, down;
    for (Index v = a; v != kNone; v = reached_.at(v).from) up.push_back(v);
    for (Index v = b; v != kNone; v = reached_.at(v).from) down.push_back(v);
    while (up.size() > 1 && down.size() > 1 && up[up.size() - 2] == down[down.size() - 2]) {
      up.pop_back();
      down.pop_back();
    }
    up.insert(up.end(), down.rbegin() + 1, down.rend());
    return up;
  }

  const HalfEdgeMesh& mesh_;
  const Annotations& annotations_;
  const int max_edges_;
  std::unordered_map<Index, Reached> reached_;
  std::vector<Index> order_;
};

double lengthOf(const std::vector<Index>& walk, const std::vector<Vec3>& position) {
  double length = 0;
  for (std::size_t i = 0; i < walk.size(); ++i)
    length += (position[walk[i]] - position[walk[(i + 1) % walk.size()]]).norm();
  return length;
}

std::vector<Index> verticesAtHandles(const HalfEdgeMesh& mesh, const Annotations& annotations) {
  std::vector<Index> vertices;
  for (Index h = 0; h < 3 * mesh.slotCount(); ++h) {
    if (!mesh.alive(HalfEdgeMesh::triangleOf(h)) || annotations[h] == 0) continue;
    vertices.push_back(mesh.origin(h));
    vertices.push_back(mesh.target(h));
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

std::vector<std::vector<Index>> shortHandleLoops(const HalfEdgeMesh& mesh, const std::vector<Vec3>& position,
                                                 int max_edges, const Context& context) {
  const Annotations annotations(mesh, context);
  if (!annotations.isAnnotated()) return {};
  WalkFinder finder(mesh, annotations, max_edges);
  std::vector<Walk> walks;
  for (const Index v : verticesAtHandles(mesh, annotations)) {
    context.checkCancelled();
    std::vector<Index> vertices = finder.through(v);
    if (vertices.size() < 3) continue;
    const double length = lengthOf(vertices, position);
    walks.push_back({std::move(vertices), length});
  }
  std::stable_sort(walks.begin(), walks.end(), [](const Walk& a, const Walk& b) {
    return a.vertices.size() != b.vertices.size() ? a.vertices.size() < b.vertices.size()
                                                  : a.length < b.length;
  });
  std::vector<char> taken(static_cast<std::size_t>(mesh.vertexCount()), 0);
  std::vector<std::vector<Index>> loops;
  for (Walk& walk : walks) {
    if (std::any_of(walk.vertices.begin(), walk.vertices.end(), [&](Index v) { return taken[v] != 0; }))
      continue;
    for (const Index v : walk.vertices) {
      for (Index h = mesh.firstOutgoing(v); h != kNone; h = mesh.nextOutgoing(h)) {
        taken[mesh.target(h)] = taken[mesh.opposite(h)] = 1;
      }
      taken[v] = 1;
    }
    loops.push_back(std::move(walk.vertices));
  }
  return loops;
}

}  // namespace mlsmesh::core

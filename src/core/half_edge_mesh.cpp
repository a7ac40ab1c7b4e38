// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/core/half_edge_mesh.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <limits>
#include <numeric>
#include <utility>

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parallel.h"

namespace mlsmesh::core {

namespace {

/// Where a half-edge goes when the corners of its triangle (a, b, c) become (a, c, b).
Index reversedSlot(Index half_edge) {
  if (half_edge == kNone) return kNone;
  return 3 * (half_edge / 3) + 2 - half_edge % 3;
}

std::string edgeText(Index u, Index v) {
  return std::to_string(u) + " -> " + std::to_string(v);
}

std::string cornerFault(const Triangle& corners, Index vertices) {
  for (const Index corner : corners)
    if (corner < 0 || corner >= vertices)
      return "names vertex " + std::to_string(corner) + ", which does not exist";
  const auto [a, b, c] = corners;
  return a == b || b == c || c == a ? "names a vertex twice" : "";
}

std::string edgeFault(const HalfEdgeMesh& mesh, const Triangle& corners) {
  for (int i = 0; i < 3; ++i) {
    const Index u = corners[i], v = corners[(i + 1) % 3];
    if (mesh.find(u, v) != kNone) return "runs edge " + edgeText(u, v) + ", which another triangle runs";
  }
  return {};
}

// The first triangle that does not fit those before it; empty if all do.
std::string firstFault(Index vertices, const std::vector<Triangle>& triangles, CancelCheck& check) {
  HalfEdgeMesh mesh(vertices);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    check();
    std::string fault = cornerFault(triangles[i], vertices);
    if (fault.empty() && mesh.addTriangle(triangles[i][0], triangles[i][1], triangles[i][2]) == kNone)
      fault = edgeFault(mesh, triangles[i]);
    if (!fault.empty()) return "triangle " + std::to_string(i) + " " + fault;
  }
  return {};
}

}  // namespace

HalfEdgeMesh::HalfEdgeMesh(Index vertices) : first_(vertices, kNone) {}

Index HalfEdgeMesh::addVertex() {
  if (vertexCount() == std::numeric_limits<Index>::max())
    throw Failure(StatusCode::IndexOverflow, "the mesh has more vertices than 32-bit indices can name");
  first_.push_back(kNone);
  return vertexCount() - 1;
}

void HalfEdgeMesh::reserveTriangles(Index count) {
  const std::size_t half_edges = 3 * static_cast<std::size_t>(count);
  vertex_.reserve(half_edges);
  twin_.reserve(half_edges);
  next_out_.reserve(half_edges);
}

Index HalfEdgeMesh::find(Index u, Index v) const {
  for (Index h = first_[u]; h != kNone; h = next_out_[h])
    if (target(h) == v) return h;
  return kNone;
}

Index HalfEdgeMesh::degree(Index vertex) const {
  Index count = 0;
  for (Index h = first_[vertex]; h != kNone; h = next_out_[h]) ++count;
  return count;
}

Index HalfEdgeMesh::fanCount(Index vertex) const {
  Index count = 0;
  for (Index h = first_[vertex]; h != kNone; h = next_out_[h])
    if (isBorder(h) || startsClosedFan(h)) ++count;
  return count;
}

bool HalfEdgeMesh::startsClosedFan(Index half_edge) const {
  Index h = half_edge;
  do {
    h = turn(h);
    if (h < half_edge) return false;
  } while (h != half_edge);
  return true;
}

bool HalfEdgeMesh::isInterior(Index vertex) const {
  const Index start = first_[vertex];
  if (start == kNone) return false;
  Index turned = 1;
  for (Index h = turn(start); h != start; h = turn(h)) {
    if (h == kNone) return false;
    ++turned;
  }
  return turned == degree(vertex);
}

bool HalfEdgeMesh::isBorderVertex(Index vertex) const {
  for (Index h = first_[vertex]; h != kNone; h = next_out_[h])
    if (isBorder(h)) return true;
  return false;
}

bool HalfEdgeMesh::canAdd(Index a, Index b, Index c) const {
  assert(0 <= std::min({a, b, c}) && std::max({a, b, c}) < vertexCount());
  return a != b && b != c && c != a && find(a, b) == kNone && find(b, c) == kNone && find(c, a) == kNone;
}

Index HalfEdgeMesh::addTriangle(Index a, Index b, Index c) {
  if (!canAdd(a, b, c)) return kNone;
  if (vertex_.size() + 3 > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw Failure(StatusCode::IndexOverflow, "the mesh has more half-edges than 32-bit indices can name");
  const Index h = static_cast<Index>(vertex_.size());
  vertex_.insert(vertex_.end(), {a, b, c});
  twin_.insert(twin_.end(), 3, kNone);
  next_out_.insert(next_out_.end(), 3, kNone);
  linkTriangle(h);
  return h / 3;
}

bool HalfEdgeMesh::assignTriangles(const std::vector<Triangle>& triangles, const Context& context) {
  constexpr std::size_t kBlock = 1 << 14;
  if (triangles.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()) / 3)
    throw Failure(StatusCode::IndexOverflow, "the mesh has more half-edges than 32-bit indices can name");
  const std::size_t half_edges = 3 * triangles.size();
  std::fill(first_.begin(), first_.end(), kNone);
  vertex_.resize(half_edges);
  twin_.resize(half_edges);
  next_out_.resize(half_edges);
  CancelCheck check(context);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    check();
    const Index h = static_cast<Index>(3 * t);
    setCorners(h, triangles[t]);
    for (Index i = 0; i < 3; ++i) link(h + i);
  }
  live_ = static_cast<Index>(triangles.size());
  std::atomic<bool> fits{true};
  parallelBlocks(context, half_edges, kBlock, [&](std::size_t first, std::size_t last) {
    for (Index h = static_cast<Index>(first); h < static_cast<Index>(last); ++h) {
      twin_[h] = find(target(h), origin(h));
      if (find(origin(h), target(h)) != h) fits = false;
    }
  });
  if (!fits) *this = HalfEdgeMesh(vertexCount());
  return fits;
}

bool HalfEdgeMesh::reviveTriangle(Index slot, Index a, Index b, Index c) {
  assert(!alive(slot));
  if (!canAdd(a, b, c)) return false;
  setCorners(3 * slot, {a, b, c});
  linkTriangle(3 * slot);
  return true;
}

// Links the triangle of this first half-edge, whose corners are set, with what is there.
void HalfEdgeMesh::linkTriangle(Index half_edge) {
  for (Index h = half_edge; h < half_edge + 3; ++h) link(h);
  for (Index h = half_edge; h < half_edge + 3; ++h) connect(h, find(target(h), origin(h)));
  ++live_;
}

void HalfEdgeMesh::removeTriangle(Index triangle) {
  assert(alive(triangle));
  const Index begin = 3 * triangle;
  for (Index h = begin; h < begin + 3; ++h) {
    if (twin_[h] != kNone) twin_[twin_[h]] = kNone;
    twin_[h] = kNone;
    unlink(h);
  }
  std::fill_n(vertex_.begin() + begin, 3, kNone);
  --live_;
}

bool HalfEdgeMesh::flip(Index half_edge) {
  if (isBorder(half_edge)) return false;
  const Index h = half_edge, h1 = next(h), h2 = previous(h);
  const Index g = twin_[h], g1 = next(g), g2 = previous(g);
  const Index u = origin(h), v = origin(g), w = origin(h2), x = origin(g2);
  if (w == x || find(w, x) != kNone || find(x, w) != kNone) return false;

  const Index beyond_vw = twin_[h1], beyond_wu = twin_[h2], beyond_ux = twin_[g1], beyond_xv = twin_[g2];
  for (const Index moved : {h, h1, h2, g, g1, g2}) unlink(moved);
  setCorners(h, {x, w, u});
  setCorners(g, {w, x, v});
  for (const Index moved : {h, h1, h2, g, g1, g2}) link(moved);
  connect(h1, beyond_wu);
  connect(h2, beyond_ux);
  connect(g1, beyond_xv);
  connect(g2, beyond_vw);
  return true;
}

std::vector<std::vector<Index>> HalfEdgeMesh::fans(Index vertex) const {
  std::vector<std::vector<Index>> result;
  for (Index h = first_[vertex]; h != kNone; h = next_out_[h]) {
    if (!isBorder(previous(h)) && !startsClosedFan(h)) continue;
    std::vector<Index>& fan = result.emplace_back();
    Index member = h;
    do {
      fan.push_back(member);
      member = turn(member);
    } while (member != kNone && member != h);
  }
  return result;
}

std::vector<Index> HalfEdgeMesh::splitFans(Index vertex) {
  std::vector<std::vector<Index>> parts = fans(vertex);
  const auto smallest = [](const std::vector<Index>& fan) {
    return *std::min_element(fan.begin(), fan.end());
  };
  std::sort(parts.begin(), parts.end(),
            [&](const auto& a, const auto& b) { return smallest(a) < smallest(b); });
  const auto kept = std::max_element(parts.begin(), parts.end(),
                                     [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::vector<Index> created;
  for (auto fan = parts.begin(); fan != parts.end(); ++fan) {
    if (fan == kept) continue;
    created.push_back(addVertex());
    for (const Index h : *fan) {
      unlink(h);
      vertex_[h] = created.back();
      link(h);
    }
  }
  return created;
}

void HalfEdgeMesh::reverse(const std::vector<Index>& triangles) {
  for (const Index triangle : triangles) {
    assert(alive(triangle));
    const Index h0 = 3 * triangle, h1 = h0 + 1, h2 = h0 + 2;
    unlink(h1);
    unlink(h2);
    std::swap(vertex_[h1], vertex_[h2]);
    link(h1);
    link(h2);
    std::swap(twin_[h0], twin_[h2]);
    for (const Index h : {h0, h1, h2}) twin_[h] = reversedSlot(twin_[h]);
  }
}

std::vector<Triangle> HalfEdgeMesh::triangles() const {
  std::vector<Triangle> result;
  result.reserve(live_);
  for (Index t = 0; t < slotCount(); ++t)
    if (alive(t)) result.push_back(corners(t));
  return result;
}

std::vector<std::vector<Index>> HalfEdgeMesh::borderLoops() const {
  std::vector<std::vector<Index>> loops = borderLoopEdges();
  for (std::vector<Index>& loop : loops)
    for (Index& item : loop) item = origin(item);
  return loops;
}

std::vector<std::vector<Index>> HalfEdgeMesh::borderLoopEdges(const Context& context) const {
  CancelCheck check(context);
  std::vector<std::vector<Index>> loops;
  std::vector<char> visited(vertex_.size(), 0);
  for (Index start = 0; start < static_cast<Index>(vertex_.size()); ++start) {
    check();
    if (vertex_[start] == kNone || !isBorder(start) || visited[start]) continue;
    std::vector<Index>& loop = loops.emplace_back();
    for (Index h = start; !visited[h]; h = nextBorder(h)) {
      visited[h] = 1;
      loop.push_back(h);
    }
  }
  return loops;
}

std::vector<Index> HalfEdgeMesh::components(Index* count, const Context& context) const {
  CancelCheck check(context);
  std::vector<Index> component(slotCount(), kNone);
  std::vector<Index> stack;
  Index found = 0;
  for (Index start = 0; start < slotCount(); ++start) {
    if (!alive(start) || component[start] != kNone) continue;
    component[start] = found;
    stack.push_back(start);
    while (!stack.empty()) {
      check();
      const Index triangle = stack.back();
      stack.pop_back();
      for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        const Index neighbor = isBorder(h) ? kNone : triangleOf(twin_[h]);
        if (neighbor == kNone || component[neighbor] != kNone) continue;
        component[neighbor] = found;
        stack.push_back(neighbor);
      }
    }
    ++found;
  }
  if (count) *count = found;
  return component;
}

Index HalfEdgeMesh::nextBorder(Index half_edge) const {
  Index h = next(half_edge);
  while (!isBorder(h)) h = next(twin_[h]);
  return h;
}

std::string HalfEdgeMesh::validate(bool allow_pinches, const Context& context) const {
  CancelCheck check(context);
  std::string fault = slotFault(check);
  if (fault.empty()) fault = twinFault(check);
  if (fault.empty()) fault = listFault(check);
  if (fault.empty() && !allow_pinches) fault = fanFault(check);
  return fault;
}

std::string HalfEdgeMesh::slotFault(CancelCheck& check) const {
  Index live = 0;
  for (Index t = 0; t < slotCount(); ++t) {
    check();
    const Triangle triangle = corners(t);
    const std::string name = "triangle " + std::to_string(t) + " ";
    if (triangle == Triangle{kNone, kNone, kNone}) {
      for (Index h = 3 * t; h < 3 * t + 3; ++h)
        if (twin_[h] != kNone) return name + "is removed but has a twin";
      continue;
    }
    const std::string fault = cornerFault(triangle, vertexCount());
    if (!fault.empty()) return name + fault;
    ++live;
  }
  if (live == live_) return {};
  return std::to_string(live) + " triangles are alive but " + std::to_string(live_) + " are counted";
}

std::string HalfEdgeMesh::twinFault(CancelCheck& check) const {
  struct Edge {
    Index u, v, half_edge;
    bool operator<(const Edge& other) const { return u != other.u ? u < other.u : v < other.v; }
  };
  std::vector<Edge> edges;
  for (Index h = 0; h < static_cast<Index>(vertex_.size()); ++h)
    if (vertex_[h] != kNone) edges.push_back({origin(h), target(h), h});
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
    check();
    return a < b;
  });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    check();
    const Edge& edge = edges[i];
    if (i > 0 && !(edges[i - 1] < edge)) return "edge " + edgeText(edge.u, edge.v) + " exists twice";
    const auto reverse = std::lower_bound(edges.begin(), edges.end(), Edge{edge.v, edge.u, kNone});
    const bool found = reverse != edges.end() && reverse->u == edge.v && reverse->v == edge.u;
    if (twin_[edge.half_edge] != (found ? reverse->half_edge : kNone))
      return "half-edge " + std::to_string(edge.half_edge) + " has the wrong twin";
  }
  return {};
}

std::string HalfEdgeMesh::listFault(CancelCheck& check) const {
  std::vector<char> listed(vertex_.size(), 0);
  Index count = 0;
  for (Index v = 0; v < vertexCount(); ++v) {
    check();
    for (Index h = first_[v]; h != kNone; h = next_out_[h]) {
      if (h < 0 || h >= static_cast<Index>(vertex_.size()) || vertex_[h] != v || listed[h])
        return "the list of vertex " + std::to_string(v) + " is broken at half-edge " + std::to_string(h);
      listed[h] = 1;
      ++count;
    }
  }
  if (count == 3 * live_) return {};
  return std::to_string(3 * live_) + " half-edges are alive but " + std::to_string(count) + " are listed";
}

std::string HalfEdgeMesh::fanFault(CancelCheck& check) const {
  std::vector<Index> leader(vertex_.size());
  std::iota(leader.begin(), leader.end(), 0);
  const auto find_leader = [&](Index h) {
    while (leader[h] != h) h = leader[h] = leader[leader[h]];
    return h;
  };
  for (Index h = 0; h < static_cast<Index>(vertex_.size()); ++h) {
    check();
    if (twin_[h] != kNone) leader[find_leader(h)] = find_leader(next(twin_[h]));
  }
  std::vector<Index> fan_of(vertexCount(), kNone);
  for (Index h = 0; h < static_cast<Index>(vertex_.size()); ++h) {
    check();
    if (vertex_[h] == kNone) continue;
    Index& fan = fan_of[vertex_[h]];
    if (fan != kNone && fan != find_leader(h))
      return "vertex " + std::to_string(vertex_[h]) + " has several fans";
    fan = find_leader(h);
  }
  return {};
}

void HalfEdgeMesh::link(Index half_edge) {
  Index& first = first_[vertex_[half_edge]];
  next_out_[half_edge] = first;
  first = half_edge;
}

void HalfEdgeMesh::unlink(Index half_edge) {
  Index* place = &first_[vertex_[half_edge]];
  while (*place != half_edge) place = &next_out_[*place];
  *place = next_out_[half_edge];
  next_out_[half_edge] = kNone;
}

void HalfEdgeMesh::setCorners(Index half_edge, const Triangle& corners) {
  vertex_[half_edge] = corners[0];
  vertex_[next(half_edge)] = corners[1];
  vertex_[previous(half_edge)] = corners[2];
}

void HalfEdgeMesh::connect(Index half_edge, Index other) {
  twin_[half_edge] = other;
  if (other != kNone) twin_[other] = half_edge;
}

bool buildMesh(Index vertices, const std::vector<Triangle>& triangles, HalfEdgeMesh& mesh, std::string* why,
               const Context& context) {
  HalfEdgeMesh built(vertices);
  CancelCheck check(context);
  const bool fits = std::all_of(triangles.begin(), triangles.end(),
                                [&](const Triangle& t) { return cornerFault(t, vertices).empty(); }) &&
                    built.assignTriangles(triangles, context);
  if (why) *why = fits ? std::string() : firstFault(vertices, triangles, check);
  if (fits) mesh = std::move(built);
  return fits;
}

}  // namespace mlsmesh::core

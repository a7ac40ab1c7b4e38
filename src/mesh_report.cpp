// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_report.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <iterator>
#include <limits>
#include <numeric>

#include "core/exact_predicates.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/parallel.h"
#include "mlsmesh/core/self_intersections.h"

namespace mlsmesh {

namespace {

using core::Index;
using core::kNone;
using core::Triangle;
using core::Vec3;

/// Disjoint sets of 0 .. n - 1; the leader of a set is its lowest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  Index leader(Index item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
  }
  void join(Index a, Index b) {
    a = leader(a);
    b = leader(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  Index count() const {
    Index leaders = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) leaders += parent_[i] == static_cast<Index>(i);
    return leaders;
  }

 private:
  std::vector<Index> parent_;
};

bool hasValidCorners(const Triangle& face, Index vertices) {
  const auto [low, high] = std::minmax_element(face.begin(), face.end());
  return *low >= 0 && *high < vertices && face[0] != face[1] && face[1] != face[2] && face[2] != face[0];
}

/// The edges of a soup, each with all its half-edges; half-edge 3 * face + corner runs from that corner to
/// the next.
class Soup {
 public:
  /// The faces must outlive it.
  Soup(Index vertices, const std::vector<Triangle>& faces) : vertices_(vertices), faces_(faces) {
    sortHalfEdges();
  }

  Index vertexCount() const { return vertices_; }
  Index faceCount() const { return static_cast<Index>(faces_.size()); }
  Index halfEdgeCount() const { return 3 * faceCount(); }
  Index edgeCount() const { return static_cast<Index>(begin_.size()) - 1; }
  Index faces(Index edge) const { return begin_[edge + 1] - begin_[edge]; }
  /// Half-edge of the `nth` face at an edge.
  Index halfEdge(Index edge, Index nth) const { return sorted_[begin_[edge] + nth]; }

  static Index next(Index half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
  Index origin(Index half_edge) const { return faces_[half_edge / 3][half_edge % 3]; }
  Index target(Index half_edge) const { return origin(next(half_edge)); }
  Index opposite(Index half_edge) const { return origin(next(next(half_edge))); }
  /// The corner of the half-edge's face at `vertex`, one of its ends, named by the half-edge that leaves it.
  Index cornerAt(Index half_edge, Index vertex) const {
    return origin(half_edge) == vertex ? half_edge : next(half_edge);
  }

 private:
  Index low(Index half_edge) const { return std::min(origin(half_edge), target(half_edge)); }
  Index high(Index half_edge) const { return std::max(origin(half_edge), target(half_edge)); }

  /// By (lower end, higher end, half-edge): counted into one bucket per lower end, each bucket then sorted.
  void sortHalfEdges() {
    struct Item {
      Index high, half_edge;
      bool operator<(const Item& other) const {
        return high != other.high ? high < other.high : half_edge < other.half_edge;
      }
    };
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
        sorted_[i] = items[i].half_edge;
        if (i == bucket[v] || items[i].high != items[i - 1].high) begin_.push_back(i);
      }
    }
    begin_.push_back(halfEdgeCount());
  }

  Index vertices_;
  const std::vector<Triangle>& faces_;
  std::vector<Index> sorted_;
  std::vector<Index> begin_;
};

/// Faces at an edge that repeat the vertices of an earlier one; each face is asked at the edge of its two
/// lowest vertices.
Index duplicatesAt(const Soup& soup, Index edge, std::vector<Index>& apexes) {
  const Index any = soup.halfEdge(edge, 0);
  const Index high = std::max(soup.origin(any), soup.target(any));
  apexes.clear();
  for (Index i = 0; i < soup.faces(edge); ++i) {
    const Index apex = soup.opposite(soup.halfEdge(edge, i));
    if (apex > high) apexes.push_back(apex);
  }
  std::sort(apexes.begin(), apexes.end());
  const auto distinct = std::unique(apexes.begin(), apexes.end());
  return static_cast<Index>(apexes.end() - distinct);
}

void countEdges(const Soup& soup, MeshReport& report) {
  std::vector<Index> apexes;
  for (Index edge = 0; edge < soup.edgeCount(); ++edge) {
    const Index faces = soup.faces(edge);
    if (faces == 1) ++report.border_edges;
    if (faces > 2) ++report.nonmanifold_edges;
    if (faces == 2 && soup.origin(soup.halfEdge(edge, 0)) == soup.origin(soup.halfEdge(edge, 1)))
      ++report.orientation_conflicts;
    if (faces > 1) report.duplicate_faces += duplicatesAt(soup, edge, apexes);
  }
}

Index countComponents(const Soup& soup) {
  Sets components(soup.faceCount());
  for (Index edge = 0; edge < soup.edgeCount(); ++edge)
    for (Index i = 1; i < soup.faces(edge); ++i)
      components.join(soup.halfEdge(edge, 0) / 3, soup.halfEdge(edge, i) / 3);
  return components.count();
}

/// Corners joined into fans: round a vertex, across edges of exactly two faces.
Sets joinFans(const Soup& soup) {
  Sets fans(soup.halfEdgeCount());
  for (Index edge = 0; edge < soup.edgeCount(); ++edge) {
    if (soup.faces(edge) != 2) continue;
    const Index h = soup.halfEdge(edge, 0), g = soup.halfEdge(edge, 1);
    for (const Index end : {soup.origin(h), soup.target(h)})
      fans.join(soup.cornerAt(h, end), soup.cornerAt(g, end));
  }
  return fans;
}

void countVertices(const Soup& soup, Sets& fans, MeshReport& report) {
  std::vector<Index> fan_count(soup.vertexCount(), 0);
  for (Index corner = 0; corner < soup.halfEdgeCount(); ++corner)
    if (fans.leader(corner) == corner) ++fan_count[soup.origin(corner)];
  report.isolated_vertices = static_cast<Index>(std::count(fan_count.begin(), fan_count.end(), 0));
  for (Index edge = 0; edge < soup.edgeCount(); ++edge) {
    if (soup.faces(edge) <= 2) continue;
    const Index h = soup.halfEdge(edge, 0);
    fan_count[soup.origin(h)] = fan_count[soup.target(h)] = 2;
  }
  report.nonmanifold_vertices = static_cast<Index>(
      std::count_if(fan_count.begin(), fan_count.end(), [](Index count) { return count > 1; }));
}

/// Border edges joined where one fan has both; a fan that ends on a non-manifold edge leaves an open chain,
/// not a loop.
Index countBorderLoops(const Soup& soup, Sets& fans) {
  Sets borders(soup.edgeCount());
  std::vector<Index> waiting(soup.halfEdgeCount(),
                             kNone);  // border edge of a fan that has not met the other yet
  for (Index edge = 0; edge < soup.edgeCount(); ++edge) {
    if (soup.faces(edge) != 1) continue;
    const Index h = soup.halfEdge(edge, 0);
    for (const Index end : {soup.origin(h), soup.target(h)}) {
      Index& other = waiting[fans.leader(soup.cornerAt(h, end))];
      if (other != kNone) borders.join(other, edge);
      other = other == kNone ? edge : kNone;
    }
  }
  std::vector<char> is_chain(soup.edgeCount(), 0);
  for (const Index edge : waiting)
    if (edge != kNone) is_chain[borders.leader(edge)] = 1;
  Index loops = 0;
  for (Index edge = 0; edge < soup.edgeCount(); ++edge)
    loops += soup.faces(edge) == 1 && borders.leader(edge) == edge && !is_chain[edge];
  return loops;
}

/// Sums count(first, last) over blocks of [0, size), on the context's threads.
template <typename Count>
Index sumOverBlocks(const core::Context& context, std::size_t size, const Count& count) {
  constexpr std::size_t kBlock = 1 << 14;
  std::vector<Index> sums((size + kBlock - 1) / kBlock, 0);
  core::parallelBlocks(context, size, kBlock, [&](std::size_t first, std::size_t last) {
    sums[first / kBlock] = count(static_cast<Index>(first), static_cast<Index>(last));
  });
  return std::accumulate(sums.begin(), sums.end(), Index{0});
}

/// Counts faces that are degenerate; returns whether the corners of all are three different vertices.
bool countDegenerate(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                     const core::Context& context, MeshReport& report) {
  std::atomic<bool> all_valid{true};
  report.degenerate_faces = sumOverBlocks(context, triangles.size(), [&](Index first, Index last) {
    Index degenerate = 0;
    for (Index t = first; t < last; ++t) {
      const Triangle& face = triangles[t];
      const bool valid = hasValidCorners(face, report.vertices);
      if (!valid) all_valid = false;
      degenerate += !valid || core::areCollinear(vertices[face[0]], vertices[face[1]], vertices[face[2]]);
    }
    return degenerate;
  });
  return all_valid;
}

std::vector<Triangle> validFaces(const std::vector<Triangle>& triangles, Index vertices) {
  std::vector<Triangle> faces;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(faces),
               [&](const Triangle& face) { return hasValidCorners(face, vertices); });
  return faces;
}

/// The topology of faces of which no two run an edge in the same direction, nor three share one; false, and
/// nothing is counted, of others.
bool countOriented(const std::vector<Triangle>& faces, const core::Context& context, MeshReport& report) {
  core::HalfEdgeMesh mesh(report.vertices);
  if (!mesh.assignTriangles(faces, context)) return false;
  const auto vertices = static_cast<std::size_t>(report.vertices);
  report.isolated_vertices = sumOverBlocks(context, vertices, [&](Index first, Index last) {
    Index isolated = 0;
    for (Index v = first; v < last; ++v) isolated += !mesh.isUsed(v);
    return isolated;
  });
  report.nonmanifold_vertices = sumOverBlocks(context, vertices, [&](Index first, Index last) {
    Index pinched = 0;
    for (Index v = first; v < last; ++v) pinched += mesh.fanCount(v) > 1;
    return pinched;
  });
  report.border_edges = sumOverBlocks(context, 3 * faces.size(), [&](Index first, Index last) {
    Index border = 0;
    for (Index h = first; h < last; ++h) border += mesh.isBorder(h);
    return border;
  });
  report.duplicate_faces = sumOverBlocks(context, faces.size(), [&](Index first, Index last) {
    Index duplicate = 0;
    for (Index t = first; t < last; ++t) {
      const Index other = mesh.twin(3 * t);
      duplicate += other != kNone && other < 3 * t && mesh.opposite(other) == mesh.opposite(3 * t);
    }
    return duplicate;
  });
  if (report.border_edges > 0) report.border_loops = static_cast<Index>(mesh.borderLoopEdges().size());
  mesh.components(&report.components);
  const Index face_count = mesh.triangleCount();
  const Index edges = (3 * face_count + report.border_edges) / 2;
  report.euler = report.vertices - report.isolated_vertices - edges + face_count;
  return true;
}

void countSoup(const Soup& soup, MeshReport& report) {
  countEdges(soup, report);
  Sets fans = joinFans(soup);
  countVertices(soup, fans, report);
  report.border_loops = countBorderLoops(soup, fans);
  report.components = countComponents(soup);
  report.euler = report.vertices - report.isolated_vertices - soup.edgeCount() + soup.faceCount();
}

/// All but the intersections. Whether the corners of all faces are three different vertices goes to
/// `all_valid`, the faces of which they are to `valid`, if that is not all.
MeshReport reportTopology(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                          const core::Context& context, bool& all_valid, std::vector<Triangle>& valid) {
  constexpr std::size_t most = std::numeric_limits<Index>::max();
  if (vertices.size() > most || triangles.size() > most / 3)
    throw core::Failure(StatusCode::IndexOverflow,
                        "the mesh has more half-edges than 32-bit indices can name");
  MeshReport report;
  report.vertices = static_cast<Index>(vertices.size());
  report.triangles = static_cast<Index>(triangles.size());
  all_valid = countDegenerate(vertices, triangles, context, report);
  if (!all_valid) valid = validFaces(triangles, report.vertices);
  const std::vector<Triangle>& counted = all_valid ? triangles : valid;
  if (!countOriented(counted, context, report)) countSoup(Soup(report.vertices, counted), report);
  if (report.components > 0 && report.isManifold() && report.orientation_conflicts == 0)
    report.genus = (2 * report.components - report.euler - report.border_loops) / 2;
  return report;
}

}  // namespace

MeshReport reportMesh(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  bool all_valid = true;
  std::vector<Triangle> valid;
  return reportTopology(vertices, triangles, {}, all_valid, valid);
}

MeshReport reportMesh(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                      const core::Context& context) {
  bool all_valid = true;
  std::vector<Triangle> valid;
  MeshReport report = reportTopology(vertices, triangles, context, all_valid, valid);
  const std::vector<Triangle>& counted = all_valid ? triangles : valid;
  report.self_intersections = core::SelfIntersections(vertices, counted, context).count();
  return report;
}

}  // namespace mlsmesh

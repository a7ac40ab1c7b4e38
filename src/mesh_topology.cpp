// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_topology.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "core/disjoint_sets.h"
#include "core/exact_predicates.h"
#include "edge_table.h"
#include "exact_origin.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/self_intersections.h"
#include "mlsmesh/mesh_welding.h"
#include "soup_fans.h"

namespace mlsmesh {

namespace {

using core::DisjointSets;
using core::Index;
using core::kNone;
using core::Triangle;
using core::TwoSidedSets;
using core::Vec3;

/// Counts what a soup has, into the whole and into its components.
class Census {
 public:
  Census(const std::vector<Vec3>& vertices, const EdgeTable& edges)
      : vertices_(vertices), edges_(edges), fans_(joinFans(edges)) {}

  MeshTopology take() {
    findComponents();
    measureFaces();
    countEdges();
    countDuplicates();
    countVertices();
    findBorders();
    checkOrientability();
    sumUp();
    return std::move(result_);
  }

 private:
  ComponentTopology& componentOf(Index vertex) { return result_.components[component_[vertex]]; }
  std::array<Index, 2> endsOf(Index edge) const {
    const Index h = edges_.halfEdge(edge, 0);
    return {edges_.origin(h), edges_.target(h)};
  }

  void findComponents();
  void measureFaces();
  void countEdges();
  void countDuplicates();
  void countVertices();
  void findBorders();
  void checkOrientability();
  void sumUp();

  const std::vector<Vec3>& vertices_;
  const EdgeTable& edges_;
  MeshTopology result_;
  std::vector<Index> component_;  ///< of every vertex; kNone if in no face
  DisjointSets fans_;             ///< of corners: round a vertex, across edges of two faces
};

void Census::findComponents() {
  DisjointSets connected(static_cast<std::size_t>(edges_.vertexCount()));
  component_.assign(edges_.vertexCount(), kNone);
  for (Index f = 0; f < edges_.faceCount(); ++f) {
    const auto [a, b, c] = edges_.face(f);
    connected.join(a, b);
    connected.join(a, c);
    component_[a] = component_[b] = component_[c] = 0;
  }
  for (Index v = 0; v < edges_.vertexCount(); ++v) {
    if (component_[v] == kNone) {
      ++result_.isolated_vertices;
      continue;
    }
    const Index leader = connected.leader(v);
    if (leader == v) result_.components.emplace_back();
    component_[v] = leader == v ? static_cast<Index>(result_.components.size()) - 1 : component_[leader];
    ++componentOf(v).vertices;
  }
}

void Census::measureFaces() {
  const Vec3 origin = vertices_.empty() ? Vec3(0, 0, 0) : vertices_.front();
  for (Index f = 0; f < edges_.faceCount(); ++f) {
    const auto [i, j, k] = edges_.face(f);
    const Vec3 a = vertices_[i] - origin, b = vertices_[j] - origin, c = vertices_[k] - origin;
    ComponentTopology& component = componentOf(i);
    ++component.triangles;
    component.area += 0.5 * (b - a).cross(c - a).norm();
    component.volume += a.dot(b.cross(c)) / 6;
  }
}

void Census::countEdges() {
  DisjointSets connected(static_cast<std::size_t>(edges_.faceCount()));
  for (Index edge = 0; edge < edges_.edgeCount(); ++edge) {
    const Index faces = edges_.facesAt(edge);
    ComponentTopology& component = componentOf(endsOf(edge)[0]);
    ++component.edges;
    if (faces == 1) ++component.border_edges;
    if (faces > 2) ++component.nonmanifold_edges;
    if (faces == 2 && edges_.isConflict(edge)) ++component.orientation_conflicts;
    for (Index i = 1; i < faces; ++i)
      connected.join(edges_.halfEdge(edge, 0) / 3, edges_.halfEdge(edge, i) / 3);
  }
  result_.edge_components = connected.count();
}

/// Each face is asked at the edge of its two lowest vertices.
void Census::countDuplicates() {
  std::vector<Index> apexes;
  for (Index edge = 0; edge < edges_.edgeCount(); ++edge) {
    if (edges_.facesAt(edge) < 2) continue;
    const auto [a, b] = endsOf(edge);
    apexes.clear();
    for (Index i = 0; i < edges_.facesAt(edge); ++i) {
      const Index apex = edges_.opposite(edges_.halfEdge(edge, i));
      if (apex > std::max(a, b)) apexes.push_back(apex);
    }
    std::sort(apexes.begin(), apexes.end());
    result_.duplicate_faces += static_cast<Index>(apexes.end() - std::unique(apexes.begin(), apexes.end()));
  }
}

void Census::countVertices() {
  const std::vector<VertexFault> faults = vertexFaults(edges_, fans_);
  for (Index v = 0; v < edges_.vertexCount(); ++v) {
    if (faults[v] == VertexFault::BowTie) ++result_.bow_tie_vertices;
    if (faults[v] != VertexFault::None) ++componentOf(v).nonmanifold_vertices;
  }
}

/// A fan that ends on a non-manifold edge leaves its border open.
void Census::findBorders() {
  std::vector<char> is_open;
  DisjointSets joined = joinBorderEdges(edges_, fans_, is_open);
  std::vector<Index> border_of(edges_.edgeCount(), kNone);  // of leaders, which come first
  for (Index edge = 0; edge < edges_.edgeCount(); ++edge) {
    if (edges_.facesAt(edge) != 1) continue;
    const Index leader = joined.leader(edge);
    const auto [a, b] = endsOf(edge);
    if (leader == edge) {
      border_of[edge] = static_cast<Index>(result_.borders.size());
      result_.borders.push_back({component_[a], 0, 0.0, is_open[edge] == 0});
    }
    Border& border = result_.borders[border_of[leader]];
    ++border.edges;
    border.length += (vertices_[b] - vertices_[a]).norm();
  }
  for (const Border& border : result_.borders) {
    ComponentTopology& component = result_.components[border.component];
    ++(border.is_loop ? component.border_loops : component.border_chains);
  }
}

/// Faces across an edge of two are on the same side of the surface, unless they run it in the same direction.
void Census::checkOrientability() {
  TwoSidedSets sides(static_cast<std::size_t>(edges_.faceCount()));
  for (Index edge = 0; edge < edges_.edgeCount(); ++edge) {
    if (edges_.facesAt(edge) != 2) continue;
    const Index f = edges_.halfEdge(edge, 0) / 3, g = edges_.halfEdge(edge, 1) / 3;
    if (!sides.join(f, g, edges_.isConflict(edge))) componentOf(endsOf(edge)[0]).orientable = false;
  }
}

void addUp(const ComponentTopology& component, MeshTopology& total) {
  total.edges += component.edges;
  total.border_edges += component.border_edges;
  total.nonmanifold_edges += component.nonmanifold_edges;
  total.nonmanifold_vertices += component.nonmanifold_vertices;
  total.orientation_conflicts += component.orientation_conflicts;
  total.border_loops += component.border_loops;
  total.border_chains += component.border_chains;
  total.closed_components += component.isClosed();
  total.inward_components += component.isInward();
  total.euler += component.euler();
  total.orientable = total.orientable && component.orientable;
  const std::optional<Index> genus = component.genus();
  if (total.genus && genus)
    *total.genus += *genus;
  else
    total.genus.reset();
}

/// Sums, and puts components and borders in their order.
void Census::sumUp() {
  std::vector<ComponentTopology>& components = result_.components;
  if (!components.empty()) result_.genus = 0;
  for (const ComponentTopology& component : components) addUp(component, result_);
  std::vector<Index> order(components.size()), rank(components.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return components[a].triangles > components[b].triangles; });
  std::vector<ComponentTopology> sorted;
  sorted.reserve(order.size());
  for (const Index component : order) {
    rank[component] = static_cast<Index>(sorted.size());
    sorted.push_back(components[component]);
  }
  components.swap(sorted);
  for (Border& border : result_.borders) border.component = rank[border.component];
  std::stable_sort(result_.borders.begin(), result_.borders.end(),
                   [](const Border& a, const Border& b) { return a.length > b.length; });
}

Index countCoincident(const std::vector<Vec3>& vertices) {
  const std::vector<Index> first = firstAtSamePosition(vertices);
  Index coincident = 0;
  for (std::size_t v = 0; v < first.size(); ++v) coincident += first[v] != static_cast<Index>(v);
  return coincident;
}

Index countDegenerate(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  const auto count = static_cast<Index>(vertices.size());
  return static_cast<Index>(std::count_if(triangles.begin(), triangles.end(), [&](const Triangle& face) {
    return !hasThreeCorners(face, count) ||
           core::areCollinear(vertices[face[0]], vertices[face[1]], vertices[face[2]]);
  }));
}

}  // namespace

std::optional<Index> ComponentTopology::genus() const {
  if (!isManifold() || !orientable) return std::nullopt;
  return (2 - euler() - border_loops) / 2;
}

MeshTopology meshTopology(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  constexpr std::size_t kMost = std::numeric_limits<Index>::max();
  if (vertices.size() > kMost)
    throw core::Failure(StatusCode::IndexOverflow, "the mesh has more vertices than 32-bit indices can name");
  const auto count = static_cast<Index>(vertices.size());
  const EdgeTable edges(count, facesWithThreeCorners(triangles, count));
  MeshTopology topology = Census(vertices, edges).take();
  topology.vertices = count;
  topology.triangles = static_cast<Index>(triangles.size());
  topology.coincident_vertices = countCoincident(vertices);
  topology.degenerate_faces = countDegenerate(vertices, triangles);
  return topology;
}

std::int64_t countSelfIntersections(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                                    const core::Context& context) {
  const std::vector<Vec3> positions = movedNearOrigin(vertices);
  const std::vector<Triangle> faces = facesWithThreeCorners(triangles, static_cast<Index>(vertices.size()));
  return core::SelfIntersections(positions, faces, context).count();
}

}  // namespace mlsmesh

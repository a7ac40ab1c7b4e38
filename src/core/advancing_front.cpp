// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution surface approximation",
//   SIBGRAPI 2003, section 2.3: the advancing front over k nearest neighbours.
// - D. Boltcheva, B. Levy, "Surface reconstruction by computing restricted Voronoi cells in parallel", 2017,
// and
//   U. Adamy, J. Giesen, M. John, 2002: most triangles come from local stars that agree (delaunay_stars.cpp).
// - D. Cohen-Steiner, F. Da, 2004: a priority queue, and edges that are put off until their surroundings are
// settled. Departures: the front starts from what the stars agree on and only closes what is left (2-8 % of
// the triangles); pinched vertices are normal while it grows and are resolved at the end.
#include "mlsmesh/core/advancing_front.h"

#include <algorithm>
#include <queue>

#include "border_fill.h"
#include "border_trim.h"
#include "delaunay_stars.h"
#include "front_rules.h"
#include "healing.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/parallel.h"
#include "outward.h"
#include "overlap_tests.h"
#include "pinches.h"
#include "seams.h"
#include "vertex_data.h"
#include "wide_neighbors.h"

namespace mlsmesh::core {
namespace {

constexpr int kRetries = 8;          // times that one border edge may look for another apex
constexpr int kSweeps = 4;           // rounds over all border edges after the queue has run dry
constexpr std::int64_t kLooks = 20;  // at border edges in such rounds, a point; then at new ones alone
constexpr int kFreeNeighbors = 6;    // a restart needs so many unused neighbours around each of its points
constexpr Index kLeastIsland = 8;    // triangles of an island that may start a further component
constexpr Index kLargestDroppedFan = 3;

Failure noTriangles() {
  return {StatusCode::NoTriangles, "no triangle fits the points; they may be too sparse or scattered"};
}

struct Entry {
  double key;
  Index half_edge;
  Index apex;  // kNone: not looked for yet
  bool was_legal;
};

struct Later {
  bool operator()(const Entry& a, const Entry& b) const {
    return a.key > b.key || (a.key == b.key && a.half_edge > b.half_edge);
  }
};

class Front {
 public:
  Front(const FrontInput& input, const TriangulationParameters& parameters, const Context& context,
        HalfEdgeMesh& mesh, FrontStatistics& statistics)
      : parameters_(parameters),
        check_(context),
        mesh_(mesh),
        rules_(input, mesh, parameters),
        statistics_(statistics) {}

  /// Adds triangles that are known to be good; false for those that do not fit what is there.
  bool load(const Triangle& triangle) {
    check_();
    const bool added = mesh_.addTriangle(triangle[0], triangle[1], triangle[2]) != kNone;
    if (added) rules_.added(triangle);
    statistics_.seed_triangles += added ? 1 : 0;
    return added;
  }

  /// Works off all border edges, those of loaded triangles too, until nothing fits any more.
  void grow() {
    const bool first_in_first_out = parameters_.order == FrontOrder::FirstInFirstOut;
    const Index own = next_slot_;
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      enqueueFrom(sweep == 0 || looks_ > kLooks * mesh_.vertexCount() ? own : 0);
      const Index before = mesh_.triangleCount();
      workOff();
      next_slot_ = 3 * mesh_.slotCount();
      if (mesh_.triangleCount() == before || first_in_first_out) return;
    }
  }

 private:
  // The border edges from this half-edge on. Counts the looks that this takes at edges of earlier growth,
  // which a cloud of many small islands would take without end.
  void enqueueFrom(Index first) {
    constexpr Index kCheap = 64;  // half-edges that are passed over in the time of a look
    for (Index h = first; h < 3 * mesh_.slotCount(); ++h) {
      check_();
      if (!mesh_.alive(HalfEdgeMesh::triangleOf(h)) || !mesh_.isBorder(h)) continue;
      enqueue(h);
      if (first == 0) ++looks_;
    }
    if (first == 0) looks_ += 3 * mesh_.slotCount() / kCheap;
  }

  // An edge waits with the apex that seems best; whether that is legal shows when its turn comes, which for
  // many an edge it never does.
  void enqueue(Index half_edge) {
    if (parameters_.order == FrontOrder::FirstInFirstOut) {
      queue_.push({static_cast<double>(sequence_++), half_edge, kNone, false});
    } else {
      wait(half_edge, rules_.likeliest(half_edge), false);
    }
  }

  void wait(Index half_edge, const Apex& apex, bool is_legal) {
    if (apex.vertex != kNone) queue_.push({apex.score, half_edge, apex.vertex, is_legal});
  }

  void workOff() {
    while (!queue_.empty()) {
      check_();
      Entry entry = queue_.top();
      queue_.pop();
      if (!mesh_.isBorder(entry.half_edge)) continue;
      if (entry.apex == kNone) {
        entry.apex = rules_.best(entry.half_edge).vertex;
        if (entry.apex != kNone) add(entry.half_edge, entry.apex);
      } else if (rules_.isLegal(entry.half_edge, entry.apex)) {
        add(entry.half_edge, entry.apex);
      } else if (!entry.was_legal || mayRetry(entry.half_edge)) {
        wait(entry.half_edge, rules_.best(entry.half_edge), true);
      }
    }
  }

  bool mayRetry(Index half_edge) {
    if (retries_.size() <= static_cast<std::size_t>(half_edge)) {
      retries_.resize(3 * static_cast<std::size_t>(mesh_.slotCount()), 0);
    }
    return retries_[half_edge]++ < kRetries;
  }

  void add(Index half_edge, Index apex) {
    const Index triangle = mesh_.addTriangle(mesh_.target(half_edge), mesh_.origin(half_edge), apex);
    rules_.added(mesh_.corners(triangle));
    ++statistics_.front_triangles;
    for (Index h = 3 * triangle + 1; h < 3 * triangle + 3; ++h) {
      if (mesh_.isBorder(h)) enqueue(h);
    }
  }

  const TriangulationParameters& parameters_;
  CancelCheck check_;
  HalfEdgeMesh& mesh_;
  FrontRules rules_;
  FrontStatistics& statistics_;
  std::priority_queue<Entry, std::vector<Entry>, Later> queue_;
  std::vector<unsigned char> retries_;
  std::int64_t sequence_ = 0;
  std::int64_t looks_ = 0;
  Index next_slot_ = 0;
};

// A point on which a further component may start: neither it nor its surroundings, but for what lies above or
// below it, are part of any triangle.
bool isFree(const FrontInput& input, const std::vector<Vec3>& normals, const HalfEdgeMesh& mesh,
            Index point) {
  constexpr double kAbove = 0.8;  // cosine from the normal
  if (mesh.isUsed(point)) return false;
  const auto isBeside = [&](Index q) {
    const Vec3 d = input.points[q] - input.points[point];
    return std::abs(d.dot(normals[point])) < kAbove * d.norm();
  };
  const Index* row = input.neighbors.row(point);
  return std::none_of(row, row + std::min(kFreeNeighbors, input.neighbors.k),
                      [&](Index q) { return mesh.isUsed(q) && isBeside(q); });
}

Vec3 normalOf(const FrontInput& input, const Triangle& t) {
  return unitNormal(input.points[t[0]], input.points[t[1]], input.points[t[2]]);
}

// Whether the triangles are turned against the mesh near them: the sign of the summed products of their
// normals with those of the mesh at neighbouring points.
bool isTurnedAgainst(const FrontInput& input, const HalfEdgeMesh& mesh,
                     const std::vector<Triangle>& triangles) {
  double agreement = 0;
  for (const Triangle& t : triangles) {
    const Vec3 normal = normalOf(input, t);
    for (const Index corner : t) {
      const Index* row = input.neighbors.row(corner);
      for (int i = 0; i < input.neighbors.k; ++i) {
        const Index h = mesh.firstOutgoing(row[i]);
        if (h != kNone) agreement += normal.dot(normalOf(input, mesh.corners(HalfEdgeMesh::triangleOf(h))));
      }
    }
  }
  return agreement < 0;
}

// The triangles of an island. Those of the first, most often nearly all, are not kept.
std::vector<Triangle> takeIsland(Index island, Islands& islands) {
  const Index dropped = island == 0 ? 0 : islands.begin[1];
  const auto first = islands.triangles.begin() + (islands.begin[island] - dropped);
  const auto last = islands.triangles.begin() + (islands.begin[island + 1] - dropped);
  if (island > 0) return {first, last};
  std::vector<Triangle> rest(last, islands.triangles.end());
  islands.triangles.erase(last, islands.triangles.end());
  islands.triangles.swap(rest);
  return rest;
}

// Those that the cloud has points near.
void keepSupported(const CloudSupport& support, const Context& context, std::vector<Triangle>& triangles) {
  if (!support.testsAnything()) return;
  std::vector<char> is_supported(triangles.size());
  parallelBlocks(context, triangles.size(), 2048, [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) is_supported[t] = support.supports(triangles[t]) ? 1 : 0;
  });
  std::size_t kept = 0;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_supported[t] != 0) triangles[kept++] = triangles[t];
  }
  triangles.resize(kept);
}

void growFromIslands(const FrontInput& input, const std::vector<Vec3>& normals, Islands islands,
                     const TriangulationParameters& parameters, const Context& context, HalfEdgeMesh& mesh,
                     Front& front) {
  mesh.reserveTriangles(
      std::max(islands.begin.back(), 2 * mesh.vertexCount()));  // about as many as Euler says
  for (Index i = 0; i < islands.count(); ++i) {
    std::vector<Triangle> usable = takeIsland(i, islands);
    keepSupported(input.support, context, usable);
    const auto isUsed = [&](const Triangle& t) {
      return std::any_of(t.begin(), t.end(), [&](Index v) { return !isFree(input, normals, mesh, v); });
    };
    if (i > 0) usable.erase(std::remove_if(usable.begin(), usable.end(), isUsed), usable.end());
    context.checkCancelled();
    if (usable.empty() || (i > 0 && static_cast<Index>(usable.size()) < kLeastIsland)) continue;
    if (i == 0 ? isInsideOut(input.points, usable) : isTurnedAgainst(input, mesh, usable)) {
      for (Triangle& t : usable) std::swap(t[1], t[2]);
    }
    for (const Triangle& t : usable) front.load(t);
    std::vector<Triangle>().swap(usable);
    front.grow();
    if (!parameters.restart) return;
  }
}

// The paper's first triangle at p: its nearest neighbour q and the r that sees pq under the largest angle.
Triangle seedAt(const FrontInput& input, Index p, double length_limit) {
  const auto& x = input.points;
  const Index* row = input.neighbors.row(p);
  const Index q = row[0];
  Triangle best{kNone, kNone, kNone};
  double widest = 0;
  for (int i = 1; i < input.neighbors.k; ++i) {
    const Index r = row[i];
    const Vec3 a = x[p] - x[r];
    const Vec3 b = x[q] - x[r];
    const double sine = a.cross(b).norm();
    if (sine <= 1e-3 * a.norm() * b.norm() || std::max(a.norm(), b.norm()) > length_limit) continue;
    const double angle = std::atan2(sine, a.dot(b));
    if (angle > widest) {
      widest = angle;
      best = {p, q, r};
    }
  }
  return best;
}

void growFromSingleTriangles(const FrontInput& input, const std::vector<Vec3>& normals,
                             const TriangulationParameters& parameters, const Context& context,
                             HalfEdgeMesh& mesh, Front& front) {
  const FrontRules rules(input, mesh, parameters);
  CancelCheck check(context);
  for (Index p = 0; p < mesh.vertexCount(); ++p) {
    check();
    if (!isFree(input, normals, mesh, p)) continue;
    const Triangle seed = seedAt(input, p, rules.lengthLimit(p, input.neighbors.row(p)[0]));
    if (seed[0] == kNone || !isFree(input, normals, mesh, seed[1]) || !isFree(input, normals, mesh, seed[2]))
      continue;
    front.load(seed);
    front.grow();
    if (!parameters.restart) return;
  }
}

void closeLoops(const std::vector<Vec3>& points, const FillLimits& limits, const Context& context,
                HalfEdgeMesh& mesh, FrontStatistics& statistics) {
  const FillCount filled = fillLoops(mesh, points, limits, context);
  statistics.filled_loops += filled.loops;
  statistics.filled_triangles += filled.triangles;
}

void growFronts(const FrontInput& input, const std::vector<Vec3>& normals,
                const TriangulationParameters& parameters, const Context& context, HalfEdgeMesh& mesh,
                FrontStatistics& statistics) {
  Front front(input, parameters, context, mesh, statistics);
  if (parameters.seeds == SeedRule::AgreedStars) {
    Islands islands = agreedIslands(
        localStars(input.points, normals, input.neighbors, input.spacing, parameters.length_factor, context),
        context);
    growFromIslands(input, normals, std::move(islands), parameters, context, mesh, front);
  }
  if (mesh.triangleCount() == 0) growFromSingleTriangles(input, normals, parameters, context, mesh, front);
  if (mesh.triangleCount() == 0) throw noTriangles();
}

CloudSupport supportOf(const TriangulationInput& input, const VertexData& data, double reach) {
  if (!input.cloud) return {};
  CloudSupport support(data.points.get(), data.cloud_spacing.get(), *input.cloud, reach);
  if (input.cloud_points && input.cloud_nearest) {
    support.knowNearest(*input.cloud_points, data.cloud_nearest.get());
  }
  return support;
}

// Triangulates, as far as fronts come; completes the normals and the spacing.
HalfEdgeMesh growMesh(const TriangulationInput& input, const TriangulationParameters& parameters,
                      const Context& context, VertexData& data, FrontStatistics& statistics) {
  const std::vector<Vec3>& points = input.points;
  NeighborTable own_neighbors;
  const bool are_known = input.neighbors && input.normals;
  const NeighborTable& neighbors = are_known ? *input.neighbors : own_neighbors;
  const auto own_search = input.search || are_known ? nullptr : makeKdTreeOver(points, context);
  const NeighborSearch* search = input.search ? input.search : own_search.get();
  if (!are_known) own_neighbors = nearestOfAll(points, *search, parameters.neighbors, context);
  std::vector<double> spacing = localSpacings(points, neighbors, context);
  if (!input.normals) {
    std::vector<char> on_line;
    std::vector<Vec3> normals = tangentNormals(points, neighbors, context, &on_line);
    if (std::find(on_line.begin(), on_line.end(), 1) != on_line.end())
      widenLines(points, on_line, *search, context, own_neighbors, spacing, normals);
    data.normals = std::move(normals);
  }
  HalfEdgeMesh mesh(static_cast<Index>(points.size()));
  const std::vector<double>& local = input.cloud_spacing ? spacing : data.cloud_spacing.get();
  if (!input.cloud_spacing) data.cloud_spacing = std::move(spacing);
  const CloudSupport support = supportOf(input, data, parameters.support_reach);
  growFronts({points, neighbors, local, support}, data.normals.get(), parameters, context, mesh, statistics);
  return mesh;
}

Index unusedPoints(const HalfEdgeMesh& mesh, std::size_t points) {
  Index unused = 0;
  for (std::size_t p = 0; p < points; ++p) unused += mesh.isUsed(static_cast<Index>(p)) ? 0 : 1;
  return unused;
}

}  // namespace

Triangulation triangulate(const TriangulationInput& input, const TriangulationParameters& parameters,
                          const Context& context) {
  if (input.points.size() < 3) throw noTriangles();
  Triangulation result;
  VertexData data(input);
  HalfEdgeMesh mesh = growMesh(input, parameters, context, data, result.statistics);
  const auto closeSmallLoops = [&] {
    const FillLimits limits{parameters.fill_max_edges, parameters.fill_max_perimeter, input.spacing,
                            &data.cloud_spacing.get()};
    if (parameters.fill_small_loops) closeLoops(data.points.get(), limits, context, mesh, result.statistics);
  };
  closeSmallLoops();
  context.checkCancelled();
  const PinchCount pinches =
      resolvePinches(mesh, kLargestDroppedFan, input.may_split ? &result.duplicate_of : nullptr, context);
  result.statistics.dropped_triangles = pinches.dropped_triangles;
  result.statistics.split_vertices = pinches.split_vertices;
  context.checkCancelled();
  data.appendCopies(result.duplicate_of);
  closeSmallLoops();
  context.checkCancelled();
  const std::vector<Vec3>&points = data.points.get(), &normals = data.normals.get();
  if (parameters.heal) {
    const CloudSupport support = supportOf(input, data, parameters.support_reach);
    Healing healing = healMesh(mesh, {points, normals, support}, parameters, context);
    result.statistics.healing = healing.statistics;
    result.troubled = std::move(healing.troubled);
    result.statistics.dropped_triangles += trimFlaps(mesh, points, normals, context);
  }
  orientOutward(points, mesh, context);
  const SeamCount seams = countSeams(mesh, points, normals, context);
  result.statistics.seams = seams.seams;
  result.statistics.seam_edges = seams.edges;
  result.statistics.unused_points = unusedPoints(mesh, input.points.size());
  result.triangles = mesh.triangles();
  if (result.triangles.empty()) throw noTriangles();
  return result;
}

}  // namespace mlsmesh::core

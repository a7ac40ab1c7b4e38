// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - M. Attene, "A lightweight approach to repairing digitized polygon meshes", The Visual Computer 2010:
//   intersecting triangles go, with growing surroundings, and the holes are filled again.
// - I. Guskov, Z. Wood, "Topological noise removal", Graphics Interface 2001: handles that a short loop goes
//   round are cut, and both sides closed. Departure: a thin part of the surface has such loops too, so a cut
//   stands only where its caps lie along the surface better than what it took out.
#include "healing.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "handle_loops.h"
#include "local_repair.h"
#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr int kMostRings = 3;     // around triangles that meet
constexpr int kHandleEdges = 14;  // of a walk round a handle that may be false
constexpr int kHandleRounds = 8;
constexpr double kAlong = 0.6;  // mean lean of a fill that belongs to the surface
constexpr double kDisc = 4;  // triangles beside a gap, per squared edge of its loop: ten times those inside
// Mean lean, side and all, of a fill that is turned against what it closes: the rim of a small sheet has the
// points of the sheet all around.
constexpr double kTurned = 1.3;

class Healer {
 public:
  Healer(HalfEdgeMesh& mesh, const HealingInput& input, const TriangulationParameters& parameters,
         const Context& context)
      : input_(input),
        parameters_(parameters),
        context_(context),
        mesh_(mesh),
        surgery_(mesh, input.points, context),
        repair_(surgery_) {}

  Healing run() {
    if (parameters_.fill_small_loops) fillSupportedLoops();
    const bool repaired = repairMeetings();
    const bool cut = cutHandles();
    if ((repaired || cut) && parameters_.fill_small_loops) fillSupportedLoops();
    statistics_.handles = handleCount();
    statistics_.intersections = static_cast<std::int64_t>(surgery_.pairs().size());
    return {statistics_, distinct(std::move(troubled_))};
  }

 private:
  void fillSupportedLoops() {
    if (!input_.support.testsAnything() || surgery_.borderEdges() == 0) return;
    const std::vector<Index> room = trianglesAround();
    for (const std::vector<Index>& loop : mesh_.borderLoopEdges(context_)) {
      if (static_cast<int>(loop.size()) > parameters_.fill_supported_edges) continue;
      const double disc = kDisc * static_cast<double>(loop.size()) * static_cast<double>(loop.size());
      if (disc > room[HalfEdgeMesh::triangleOf(loop[0])]) continue;
      context_.checkCancelled();
      std::vector<Index> vertices;
      for (const Index h : loop) vertices.push_back(mesh_.origin(h));
      vertices = distinct(std::move(vertices));
      bool is_hole = false;
      const std::size_t mark = surgery_.mark();
      const auto fill = [&] {
        if (!repair_.close(loop)) return false;
        const Region added = surgery_.addedSince(mark);
        is_hole = !isNearCloud(added) || meanLean(added) >= kAlong;
        return !is_hole && leanFromAround(added) < kTurned;
      };
      const auto closes = [](const LocalTopology& before, const LocalTopology& after) {
        return after.loops < before.loops;
      };
      if (attempt(vertices, fill, closes))
        ++statistics_.filled_loops;
      else if (!is_hole)
        noteTrouble(vertices);
    }
  }

  // Of every triangle, how many its component has.
  std::vector<Index> trianglesAround() const {
    Index count = 0;
    std::vector<Index> component = mesh_.components(&count, context_);
    std::vector<Index> size(static_cast<std::size_t>(count), 0);
    for (const Index c : component) {
      if (c != kNone) ++size[c];
    }
    for (Index& c : component) c = c == kNone ? 0 : size[c];
    return component;
  }

  bool isNearCloud(const Region& fill) const {
    return std::all_of(fill.begin(), fill.end(), [&](Index t) {
      return input_.support.supports(mesh_.corners(t), parameters_.fill_reach);
    });
  }

  void noteTrouble(const std::vector<Index>& vertices) {
    troubled_.insert(troubled_.end(), vertices.begin(), vertices.end());
  }

  // As meanLean, with the side on which the triangles around the region lie: 0 .. 2.
  double leanFromAround(const Region& region) const {
    double sum = 0;
    for (const Index t : region) {
      const Vec3 own = normalOf(t);
      for (const Index v : mesh_.corners(t)) {
        Vec3 around = Vec3::Zero();
        for (Index h = mesh_.firstOutgoing(v); h != kNone; h = mesh_.nextOutgoing(h)) {
          const Index other = HalfEdgeMesh::triangleOf(h);
          if (!std::binary_search(region.begin(), region.end(), other)) around += normalOf(other);
        }
        const Vec3& normal = input_.normals[v];
        sum += own.dot(normal.dot(around) < 0 ? Vec3(-normal) : normal);
      }
    }
    return region.empty() ? 0 : 1 - sum / (3 * static_cast<double>(region.size()));
  }

  Vec3 normalOf(Index triangle) const {
    const auto [a, b, c] = mesh_.corners(triangle);
    return unitNormal(input_.points[a], input_.points[b], input_.points[c]);
  }

  bool repairMeetings() {
    constexpr TrianglePair kBeforeAll = {kNone, kNone};
    std::set<TrianglePair> hopeless;
    TrianglePair known = kBeforeAll;  // all pairs up to it are hopeless
    while (!repair_.isSpent()) {
      context_.checkCancelled();
      const auto next = std::find_if(surgery_.pairs().upper_bound(known), surgery_.pairs().end(),
                                     [&](const TrianglePair& pair) { return hopeless.count(pair) == 0; });
      if (next == surgery_.pairs().end()) break;
      const TrianglePair pair = *next;
      const Region place = placeOf(pair);
      noteTrouble(verticesOf(mesh_, place));
      if (repairPlace(place)) {
        ++statistics_.repaired_places;
        known = kBeforeAll;
      } else {
        hopeless.insert(pair);
        known = pair;
      }
    }
    while (!surgery_.pairs().empty()) {
      repair_.open({worseOf(*surgery_.pairs().begin())});
      handles_.reset();
      ++statistics_.opened_places;
    }
    return statistics_.repaired_places + statistics_.opened_places > 0;
  }

  // The triangle of the pair that meets more others; of equals, the one that leans more.
  Index worseOf(const TrianglePair& pair) const {
    const std::size_t met[] = {surgery_.partnersOf(pair[0]).size(), surgery_.partnersOf(pair[1]).size()};
    if (met[0] != met[1]) return pair[met[0] > met[1] ? 0 : 1];
    return pair[leanOf(mesh_.corners(pair[0])) > leanOf(mesh_.corners(pair[1])) ? 0 : 1];
  }

  // The triangles of the pair and of all pairs that are linked to it.
  Region placeOf(const TrianglePair& first) const {
    std::set<Index> place(first.begin(), first.end());
    std::vector<Index> waiting(first.begin(), first.end());
    while (!waiting.empty()) {
      const Index triangle = waiting.back();
      waiting.pop_back();
      for (const Index partner : surgery_.partnersOf(triangle)) {
        if (place.insert(partner).second) waiting.push_back(partner);
      }
    }
    return {place.begin(), place.end()};
  }

  bool repairPlace(Region place) {
    const auto meetsLess = [](const LocalTopology& before, const LocalTopology& after) {
      return after.pairs < before.pairs;
    };
    for (int ring = 0; ring <= kMostRings; ++ring, place = grown(mesh_, place)) {
      if (attempt(
              verticesOf(mesh_, place), [&] { return repair_.renew(place); }, meetsLess))
        return true;
    }
    return false;
  }

  // The genus of all components, their loops capped. Counted again only after changes.
  Index handleCount() {
    if (handles_) return *handles_;
    Index components = 0;
    mesh_.components(&components, context_);
    const auto loops =
        surgery_.borderEdges() > 0 ? static_cast<Index>(mesh_.borderLoopEdges(context_).size()) : 0;
    handles_ = components - (surgery_.euler() + loops) / 2;
    return *handles_;
  }

  bool attempt(const std::vector<Index>& vertices, const LocalRepair::Change& change,
               const LocalRepair::Helps& helps) {
    if (!repair_.attempt(vertices, change, helps)) return false;
    handles_.reset();
    return true;
  }

  bool cutHandles() {
    for (int round = 0; round < kHandleRounds && handleCount() > 0; ++round) {
      context_.checkCancelled();
      Index cut = 0;
      for (const std::vector<Index>& walk : shortHandleLoops(mesh_, input_.points, kHandleEdges, context_)) {
        if (!cutAlong(walk) && !cutAlong({walk.rbegin(), walk.rend()})) continue;
        noteTrouble(walk);
        ++cut;
      }
      statistics_.cut_handles += cut;
      if (cut == 0) break;
    }
    return statistics_.cut_handles > 0;
  }

  // Takes out the triangles left of the walk and closes both sides, if that cuts the handle and the caps are
  // more a part of the surface than they.
  bool cutAlong(const std::vector<Index>& walk) {
    const Region strip = leftOf(walk);
    const double lean = meanLean(strip);
    const std::size_t mark = surgery_.mark();
    const auto cuts = [&](const LocalTopology& before, const LocalTopology& after) {
      return after.closedness() > before.closedness() && meanLean(surgery_.addedSince(mark)) < lean;
    };
    return attempt(
        verticesOf(mesh_, strip), [&] { return repair_.renew(strip); }, cuts);
  }

  // The triangles left of a closed walk, at its vertices; those of another cut may have broken the walk.
  Region leftOf(const std::vector<Index>& walk) const {
    Region region;
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const Index before = walk[i], at = walk[(i + 1) % walk.size()], after = walk[(i + 2) % walk.size()];
      for (Index h = mesh_.find(at, after); h != kNone;) {
        region.push_back(HalfEdgeMesh::triangleOf(h));
        const Index incoming = HalfEdgeMesh::previous(h);
        h = mesh_.origin(incoming) == before ? kNone : mesh_.twin(incoming);
      }
    }
    return distinct(std::move(region));
  }

  // How far a triangle leans from the surface at its corners, 0 .. 1.
  double leanOf(const Triangle& t) const {
    const Vec3 normal = unitNormal(input_.points[t[0]], input_.points[t[1]], input_.points[t[2]]);
    double along = 0;
    for (const Index v : t) along += std::abs(normal.dot(input_.normals[v]));
    return 1 - along / 3;
  }

  double meanLean(const Region& region) const {
    double sum = 0;
    for (const Index t : region) sum += leanOf(mesh_.corners(t));
    return region.empty() ? 0 : sum / static_cast<double>(region.size());
  }

  const HealingInput input_;
  const TriangulationParameters& parameters_;
  const Context& context_;
  HalfEdgeMesh& mesh_;
  MeshSurgery surgery_;
  LocalRepair repair_;
  HealingStatistics statistics_;
  std::vector<Index> troubled_;
  std::optional<Index> handles_;  // as far as known
};

}  // namespace

Healing healMesh(HalfEdgeMesh& mesh, const HealingInput& input, const TriangulationParameters& parameters,
                 const Context& context) {
  return Healer(mesh, input, parameters, context).run();
}

}  // namespace mlsmesh::core

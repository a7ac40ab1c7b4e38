// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "cloud_support.h"
#include "mlsmesh/core/half_edge_mesh.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/parameters.h"

namespace mlsmesh::core {

/// Everything the front reads: the points, their neighbours, and what follows from both.
struct FrontInput {
  const std::vector<Vec3>& points;
  const NeighborTable& neighbors;
  const std::vector<double>& spacing;  ///< local spacing ls of every point
  const CloudSupport& support;
};

/// The apex of the next triangle on a border half-edge, kNone if there is none.
struct Apex {
  Index vertex = kNone;
  double score = 0;  ///< smaller is better
};

/// Decides which triangle may follow on a border half-edge u -> v: candidates, angle windows, length limit,
/// and the tests that keep the mesh from overlapping itself. Reads the mesh, never changes it; whoever adds a
/// triangle to it between calls says so, and none are taken. The same call on the same mesh gives the same
/// bits, so a queue entry can be checked again when it is popped. Not thread-safe: it remembers which
/// vertices are interior.
class FrontRules {
 public:
  FrontRules(const FrontInput& input, const HalfEdgeMesh& mesh, const TriangulationParameters& parameters)
      : input_(input),
        mesh_(mesh),
        parameters_(parameters),
        place_(static_cast<std::size_t>(mesh.vertexCount()), Place::Unknown) {}

  /// To be told of every triangle that was added to the mesh.
  void added(const Triangle& triangle);

  /// Best apex for the triangle (v, u, apex) as far as the three points tell, be it legal or not: bounds the
  /// score of best() within one window of angles at a fraction of its cost.
  Apex likeliest(Index half_edge) const;
  /// Best legal apex for the triangle (v, u, apex).
  Apex best(Index half_edge) const;
  /// Whether (v, u, apex) may be added as the mesh is now.
  bool isLegal(Index half_edge, Index apex) const;
  /// Longest edge that a triangle on edge uv may have.
  double lengthLimit(Index u, Index v) const;

 private:
  enum class Place : char { Unknown, Interior, Elsewhere };

  struct Candidate {
    Index apex;
    int window;
    double score;

    bool operator<(const Candidate& other) const;
  };

  const std::vector<Candidate>& candidatesFor(Index half_edge) const;
  void addCandidates(Index half_edge, const Index* row) const;
  int windowOf(double bend) const;
  double scoreOf(Index u, Index v, Index apex, double bend) const;
  bool fits(Index u, Index v, Index apex) const;
  bool overlaps(Index u, Index v, Index apex) const;
  const std::vector<Index>& obstaclesNear(const Triangle& corners) const;
  bool isInterior(Index vertex) const;

  FrontInput input_;
  const HalfEdgeMesh& mesh_;
  const TriangulationParameters& parameters_;
  mutable std::vector<Place> place_;           // of every vertex, as far as it was asked for
  mutable std::vector<Candidate> candidates_;  // room for the answer of candidatesFor
  mutable std::vector<Index> obstacles_;       // room for the answer of obstaclesNear
};

}  // namespace mlsmesh::core

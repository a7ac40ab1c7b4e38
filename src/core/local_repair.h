// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>

#include "mesh_surgery.h"

namespace mlsmesh::core {

/// Triangles of a place, ascending.
using Region = std::vector<Index>;

/// Sorts and takes out repeats.
Region distinct(Region region);
/// The region and every triangle that shares a vertex with it.
Region grown(const HalfEdgeMesh& mesh, const Region& region);
/// Vertices of the region's triangles, ascending.
std::vector<Index> verticesOf(const HalfEdgeMesh& mesh, const Region& region);

/// What a change at some vertices may not make worse.
struct LocalTopology {
  std::size_t pairs = 0;  ///< of triangles that meet where they should not
  std::size_t loops = 0;  ///< border loops at the vertices
  Index euler = 0;        ///< of the whole mesh

  /// Grows by 2 with every handle that goes, and with every component that comes.
  Index closedness() const { return euler + static_cast<Index>(loops); }
};

/// Changes to a mesh that are kept only if they help and harm nothing. Holds a reference.
class LocalRepair {
 public:
  using Change = std::function<bool()>;
  using Helps = std::function<bool(const LocalTopology& before, const LocalTopology& after)>;

  explicit LocalRepair(MeshSurgery& surgery) : surgery_(surgery) {}

  /// Does what `change` does, at these vertices alone; keeps it where it returns true, pinches none of them,
  /// makes no more meetings, loops, handles or components, and helps. Takes it back otherwise.
  bool attempt(const std::vector<Index>& vertices, const Change& change, const Helps& helps);
  /// Every attempt walks the border loops at its vertices. Once that has come to so many edges a triangle
  /// that the cloud cannot be much of a surface, no further one is made: attempt() returns false.
  bool isSpent() const;

  /// Takes the region out and closes the loops which that opens, but for those that were open before; where a
  /// whole border goes with the region, the longest loop takes its place. False (with the work half done)
  /// where one cannot be closed.
  bool renew(const Region& region);
  /// Closes the border loop that these half-edges run along, false where no fill fits.
  bool close(const std::vector<Index>& loop);
  /// Takes the region out, and of every vertex that this pinches all fans but the largest.
  void open(Region region);

 private:
  using Loops = std::vector<std::vector<Index>>;

  Loops loopsOf(const std::vector<Index>& half_edges);
  LocalTopology topologyAt(const std::vector<Index>& vertices);
  bool isPinched(const std::vector<Index>& vertices) const;
  Region smallerFans(const std::vector<Index>& vertices) const;
  Index componentCount() const;

  MeshSurgery& surgery_;
  std::int64_t walked_ = 0;   // edges of border loops
  Index components_ = kNone;  // kNone: not counted yet; no change that is kept makes more
};

}  // namespace mlsmesh::core

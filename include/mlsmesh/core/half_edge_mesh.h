// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// Triangles with their half-edges: half-edge h = 3 * triangle + corner runs from the vertex of its corner to
/// the next. Every directed edge exists at most once and an edge has at most two triangles, of opposite
/// direction: the mesh is oriented and edge-manifold at all times. A vertex may hold several fans (a pinch)
/// while a front grows. Flat arrays; the outgoing half-edges of a vertex are an intrusive list. Not
/// thread-safe for writing.
class HalfEdgeMesh {
 public:
  explicit HalfEdgeMesh(Index vertices = 0);

  Index vertexCount() const { return static_cast<Index>(first_.size()); }
  /// Triangle slots, removed ones included.
  Index slotCount() const { return static_cast<Index>(vertex_.size() / 3); }
  Index triangleCount() const { return live_; }
  bool alive(Index triangle) const { return vertex_[3 * triangle] != kNone; }
  Index addVertex();
  /// Replaces all triangles; the same mesh as adding them one by one, in parallel. False, and the mesh is
  /// left without any, if an edge would exist twice; the corners must be distinct vertices of the mesh.
  /// Throws Failure(IndexOverflow).
  bool assignTriangles(const std::vector<Triangle>& triangles, const Context& context);
  void reserveTriangles(Index count);

  static Index triangleOf(Index half_edge) { return half_edge / 3; }
  static Index next(Index half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
  static Index previous(Index half_edge) { return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1; }
  Index origin(Index half_edge) const { return vertex_[half_edge]; }
  Index target(Index half_edge) const { return vertex_[next(half_edge)]; }
  Index opposite(Index half_edge) const { return vertex_[previous(half_edge)]; }
  Index twin(Index half_edge) const { return twin_[half_edge]; }
  bool isBorder(Index half_edge) const { return twin_[half_edge] == kNone; }
  /// The outgoing half-edge beyond this one when turning around its origin, kNone at the end of an open fan.
  Index turn(Index half_edge) const { return isBorder(half_edge) ? kNone : next(twin_[half_edge]); }
  Triangle corners(Index triangle) const {
    return {vertex_[3 * triangle], vertex_[3 * triangle + 1], vertex_[3 * triangle + 2]};
  }

  /// First outgoing half-edge of a vertex, kNone if no triangle uses it; the rest by nextOutgoing.
  Index firstOutgoing(Index vertex) const { return first_[vertex]; }
  Index nextOutgoing(Index half_edge) const { return next_out_[half_edge]; }
  bool isUsed(Index vertex) const { return first_[vertex] != kNone; }
  /// The half-edge u -> v, or kNone. O(degree of u).
  Index find(Index u, Index v) const;
  Index degree(Index vertex) const;  ///< outgoing half-edges = triangles at the vertex
  Index fanCount(Index vertex) const;
  /// One closed fan and no other: nothing more fits here.
  bool isInterior(Index vertex) const;
  /// The outgoing half-edges of each fan, in turning order.
  std::vector<std::vector<Index>> fans(Index vertex) const;
  /// True when some half-edge at the vertex, outgoing or incoming, is a border: it has an open fan.
  bool isBorderVertex(Index vertex) const;

  /// True if a, b, c are distinct and none of the directed edges ab, bc, ca exists. All three must be
  /// vertices of the mesh.
  bool canAdd(Index a, Index b, Index c) const;
  /// Adds the triangle in a new slot and links twins; kNone (and no change) unless canAdd. Throws
  /// Failure(IndexOverflow).
  Index addTriangle(Index a, Index b, Index c);
  /// Takes a live triangle out; its slot stays, dead until revived.
  void removeTriangle(Index triangle);
  /// Adds the triangle in a dead slot; false (and no change) unless canAdd.
  bool reviveTriangle(Index slot, Index a, Index b, Index c);
  /// Turns the edge of h inside its two triangles, so that h and its twin are the other diagonal; false (and
  /// no change) on a border or where the new edge exists.
  bool flip(Index half_edge);
  /// Gives all fans of `vertex` but the largest (of equals, the one with the lowest triangle) a new vertex
  /// each, in order of their lowest triangle; returns the new vertices.
  std::vector<Index> splitFans(Index vertex);
  /// Reverses the orientation of the listed triangles; the list must be closed under edge adjacency.
  void reverse(const std::vector<Index>& triangles);

  /// Live triangles in slot order.
  std::vector<Triangle> triangles() const;
  /// Border loops as vertex cycles, walked by fans, so that pinches do not mix them.
  std::vector<std::vector<Index>> borderLoops() const;
  /// Outgoing border half-edges of each loop, in walking order.
  std::vector<std::vector<Index>> borderLoopEdges(const Context& context = {}) const;
  /// The border half-edge after this one on its loop, within its fan.
  Index nextBorder(Index half_edge) const;
  /// Edge-connected component of every triangle slot (kNone for removed ones), numbered in slot order.
  std::vector<Index> components(Index* count = nullptr, const Context& context = {}) const;
  /// Empty if all invariants hold (links, twins, one fan a vertex); else a text that names the first
  /// violation.
  std::string validate(bool allow_pinches = false, const Context& context = {}) const;

 private:
  void link(Index half_edge);
  void unlink(Index half_edge);
  void connect(Index half_edge, Index other);
  void setCorners(Index half_edge, const Triangle& corners);
  bool startsClosedFan(Index half_edge) const;
  void linkTriangle(Index half_edge);
  std::string slotFault(CancelCheck& check) const;
  std::string twinFault(CancelCheck& check) const;
  std::string listFault(CancelCheck& check) const;
  std::string fanFault(CancelCheck& check) const;

  std::vector<Index> vertex_;
  std::vector<Index> twin_;
  std::vector<Index> next_out_;
  std::vector<Index> first_;
  Index live_ = 0;
};

/// Builds a mesh from triangles; false where they are not an oriented edge-manifold (`why` names the first
/// offender), and then `mesh` is left as it was.
bool buildMesh(Index vertices, const std::vector<Triangle>& triangles, HalfEdgeMesh& mesh,
               std::string* why = nullptr, const Context& context = {});

}  // namespace mlsmesh::core

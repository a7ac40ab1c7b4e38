// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/half_edge_mesh.h"

namespace mlsmesh::core {

/// A triangle that is about to be added, with its unit normal and longest edge.
struct NewTriangle {
  Triangle corner;
  Vec3 normal;
  double longest = 0;
};

/// True if the sector of the triangle at its corner number `corner` overlaps that of a triangle already
/// there, both projected on the plane of their mean normal, or is itself turned over in that plane.
bool overlapsSector(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const NewTriangle& triangle,
                    int corner);

/// True if `point` (unused or on a border, same side of the surface) lies over the inside of the triangle, no
/// higher than half its longest edge.
bool containsPoint(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const NewTriangle& triangle,
                   Index point);

/// A point seen along the normal of a plane.
struct PlanePoint {
  Eigen::Vector2d flat;
  double height;
};

/// A plane with orthonormal axes in it.
struct ProjectionPlane {
  Vec3 origin;
  Vec3 normal;
  Vec3 u;
  Vec3 v;

  Eigen::Vector2d flat(const Vec3& p) const { return {(p - origin).dot(u), (p - origin).dot(v)}; }
  PlanePoint project(const Vec3& p) const { return {flat(p), (p - origin).dot(normal)}; }
};

/// Tells whether border edges cross one of the two edges between a triangle's last corner and the others,
/// seen along the triangle's normal and no farther apart than half its longest edge. The mesh, the points and
/// the triangle must outlive it.
class BorderCrossings {
 public:
  BorderCrossings(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const NewTriangle& triangle);

  /// True if a border edge at `point` does; those that come from a point in `others` (ascending) are left to
  /// the call for that one.
  bool at(Index point, const std::vector<Index>& others = {}) const;

 private:
  bool isInTheWay(Index half_edge) const;

  const HalfEdgeMesh& mesh_;
  const std::vector<Vec3>& points_;
  const NewTriangle& triangle_;
  const ProjectionPlane plane_;
  std::array<PlanePoint, 3> corner_;
};

/// Whether twice the triangle's area is at most 1e-9 of its squared longest edge.
bool isDegenerate(const Vec3& a, const Vec3& b, const Vec3& c);

/// Unit normal of three points; zero where they are collinear.
Vec3 unitNormal(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
// Departure from B. Mederos, L. Velho, L. H. de Figueiredo (SIBGRAPI 2003, section 2.3, rule ii): the printed
// test looks at the star of the new apex alone, which leaves hundreds of non-manifold vertices on real scans.
// These tests look at all three corners, at points inside the triangle and at border edges in its way.
#include "overlap_tests.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace mlsmesh::core {
namespace {

using Vec2 = Eigen::Vector2d;

constexpr double kOtherSide = -0.3;  // cosine between normals below which a triangle lies on another sheet
constexpr double kHeight = 0.5;  // of the longest edge: how far over a triangle a point or edge is in its way

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

struct Plane {
  Vec3 origin;
  Vec3 normal;
  Vec3 u;
  Vec3 v;

  Plane(const Vec3& at, const Vec3& unit_normal)
      : origin(at), normal(unit_normal), u(normal.unitOrthogonal()) {
    v = normal.cross(u);
  }
  Vec2 flat(const Vec3& p) const { return Vec2((p - origin).dot(u), (p - origin).dot(v)); }
  double height(const Vec3& p) const { return (p - origin).dot(normal); }
};

// A sector from one neighbour of a corner to the next, counter-clockwise and less than half a turn.
struct Sector {
  Index from;
  Index to;
  Vec2 a;
  Vec2 b;

  bool isTurnedOver() const { return cross(a, b) <= 0; }
  bool contains(Index vertex, const Vec2& direction) const {
    return vertex != from && vertex != to && cross(a, direction) > 0 && cross(direction, b) > 0;
  }
};

bool overlap(const Sector& s, const Sector& t) {
  if (s.from == t.from || s.to == t.to) return true;
  if (s.contains(t.from, t.a) || s.contains(t.to, t.b) || t.contains(s.from, s.a) || t.contains(s.to, s.b))
    return true;
  // Sectors that share both sides in reverse close a turn; they overlap only if one is turned over.
  return false;
}

Vec3 triangleNormal(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index half_edge) {
  return unitNormal(points[mesh.origin(half_edge)], points[mesh.target(half_edge)],
                    points[mesh.opposite(half_edge)]);
}

// Mean normal of the triangles at a border vertex, not normalised; zero if unused.
Vec3 starNormal(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index vertex) {
  Vec3 sum = Vec3::Zero();
  for (Index h = mesh.firstOutgoing(vertex); h != kNone; h = mesh.nextOutgoing(h)) {
    sum += triangleNormal(mesh, points, h);
  }
  return sum;
}

bool segmentsCross(const Plane& plane, double height, const Vec3& p, const Vec3& q, const Vec3& a,
                   const Vec3& b) {
  const Vec2 p2 = plane.flat(p);
  const Vec2 q2 = plane.flat(q);
  const Vec2 a2 = plane.flat(a);
  const Vec2 b2 = plane.flat(b);
  const double sa = cross(q2 - p2, a2 - p2);
  const double sb = cross(q2 - p2, b2 - p2);
  const double sp = cross(b2 - a2, p2 - a2);
  const double sq = cross(b2 - a2, q2 - a2);
  if (!((sa > 0) != (sb > 0) && (sp > 0) != (sq > 0)) || sa == sb || sp == sq) return false;
  const double along_ab = sa / (sa - sb);
  const double along_pq = sp / (sp - sq);
  const double gap = plane.height(a) + along_ab * (plane.height(b) - plane.height(a)) - plane.height(p) -
                     along_pq * (plane.height(q) - plane.height(p));
  return std::abs(gap) < height;
}

}  // namespace

bool isDegenerate(const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kLeastShape = 1e-9;
  const double longest = std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
  return !((b - a).cross(c - a).norm() > kLeastShape * longest);
}

Vec3 unitNormal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  const double length = n.norm();
  return length > 0 ? Vec3(n / length) : Vec3(Vec3::Zero());
}

bool overlapsSector(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const NewTriangle& triangle,
                    int corner) {
  const Index vertex = triangle.corner[corner];
  if (!mesh.isUsed(vertex)) return false;
  const Vec3 mean = starNormal(mesh, points, vertex) + triangle.normal;
  const double length = mean.norm();
  if (!(length > 1e-6)) return true;
  const Plane plane(points[vertex], mean / length);
  const auto sector = [&](Index from, Index to) {
    return Sector{from, to, plane.flat(points[from]), plane.flat(points[to])};
  };
  const Sector mine = sector(triangle.corner[(corner + 1) % 3], triangle.corner[(corner + 2) % 3]);
  if (mine.isTurnedOver()) return true;
  for (Index h = mesh.firstOutgoing(vertex); h != kNone; h = mesh.nextOutgoing(h)) {
    Sector other = sector(mesh.target(h), mesh.opposite(h));
    if (other.isTurnedOver()) {
      std::swap(other.from, other.to);
      std::swap(other.a, other.b);
    }
    if (overlap(mine, other)) return true;
  }
  return false;
}

bool containsPoint(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const NewTriangle& triangle,
                   Index point) {
  const auto& [i, j, k] = triangle.corner;
  if (point == i || point == j || point == k) return false;
  const Vec3& p = points[point];
  if (std::abs((p - points[i]).dot(triangle.normal)) > kHeight * triangle.longest) return false;
  const auto inside = [&](Index from, Index to) {
    return (points[to] - points[from]).cross(p - points[from]).dot(triangle.normal) > 0;
  };
  if (!inside(i, j) || !inside(j, k) || !inside(k, i)) return false;
  if (!mesh.isUsed(point)) return true;
  if (mesh.isInterior(point)) return false;
  return starNormal(mesh, points, point).normalized().dot(triangle.normal) > kOtherSide;
}

bool crossesBorderAt(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const NewTriangle& triangle,
                     Index point) {
  const Plane plane(points[triangle.corner[0]], triangle.normal);
  const Index apex = triangle.corner[2];
  const auto isInTheWay = [&](Index half_edge) {
    const Index a = mesh.origin(half_edge);
    const Index b = mesh.target(half_edge);
    if (a == apex || b == apex) return false;
    for (int side = 0; side < 2; ++side) {
      const Index end = triangle.corner[side];
      if (a == end || b == end) continue;
      if (!segmentsCross(plane, kHeight * triangle.longest, points[end], points[apex], points[a], points[b]))
        continue;
      if (triangleNormal(mesh, points, half_edge).dot(triangle.normal) > kOtherSide) return true;
    }
    return false;
  };
  for (Index h = mesh.firstOutgoing(point); h != kNone; h = mesh.nextOutgoing(h)) {
    if (mesh.isBorder(h) && isInTheWay(h)) return true;
    const Index incoming = HalfEdgeMesh::previous(h);
    if (mesh.isBorder(incoming) && isInTheWay(incoming)) return true;
  }
  return false;
}

}  // namespace mlsmesh::core

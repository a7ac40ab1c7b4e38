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

ProjectionPlane planeAt(const Vec3& origin, const Vec3& normal) {
  const Vec3 u = normal.unitOrthogonal();
  return {origin, normal, u, normal.cross(u)};
}

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

// Whether two segments cross, seen along the normal, at heights that differ by less than `height`.
bool segmentsCross(double height, const PlanePoint& p, const PlanePoint& q, const PlanePoint& a,
                   const PlanePoint& b) {
  const double sa = cross(q.flat - p.flat, a.flat - p.flat);
  const double sb = cross(q.flat - p.flat, b.flat - p.flat);
  if ((sa > 0) == (sb > 0)) return false;
  const double sp = cross(b.flat - a.flat, p.flat - a.flat);
  const double sq = cross(b.flat - a.flat, q.flat - a.flat);
  if ((sp > 0) == (sq > 0)) return false;
  const double along_ab = sa / (sa - sb);
  const double along_pq = sp / (sp - sq);
  const double gap =
      a.height + along_ab * (b.height - a.height) - p.height - along_pq * (q.height - p.height);
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
  const ProjectionPlane plane = planeAt(points[vertex], mean / length);
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

BorderCrossings::BorderCrossings(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points,
                                 const NewTriangle& triangle)
    : mesh_(mesh),
      points_(points),
      triangle_(triangle),
      plane_(planeAt(points[triangle.corner[0]], triangle.normal)) {
  for (std::size_t i = 0; i < 3; ++i) corner_[i] = plane_.project(points[triangle.corner[i]]);
}

bool BorderCrossings::at(Index point, const std::vector<Index>& others) const {
  const auto isLeft = [&](Index h) {
    return std::binary_search(others.begin(), others.end(), mesh_.origin(h));
  };
  for (Index h = mesh_.firstOutgoing(point); h != kNone; h = mesh_.nextOutgoing(h)) {
    if (mesh_.isBorder(h) && isInTheWay(h)) return true;
    const Index incoming = HalfEdgeMesh::previous(h);
    if (mesh_.isBorder(incoming) && !isLeft(incoming) && isInTheWay(incoming)) return true;
  }
  return false;
}

bool BorderCrossings::isInTheWay(Index half_edge) const {
  const Index from = mesh_.origin(half_edge);
  const Index to = mesh_.target(half_edge);
  const Index apex = triangle_.corner[2];
  if (from == apex || to == apex) return false;
  const PlanePoint a = plane_.project(points_[from]);
  const PlanePoint b = plane_.project(points_[to]);
  for (std::size_t side = 0; side < 2; ++side) {
    const Index end = triangle_.corner[side];
    if (from == end || to == end) continue;
    if (!segmentsCross(kHeight * triangle_.longest, corner_[side], corner_[2], a, b)) continue;
    if (triangleNormal(mesh_, points_, half_edge).dot(triangle_.normal) > kOtherSide) return true;
  }
  return false;
}

}  // namespace mlsmesh::core

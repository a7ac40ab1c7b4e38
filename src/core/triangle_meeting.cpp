// SPDX-License-Identifier: BSD-3-Clause
// This work is based on P. Guigue, O. Devillers, "Fast and robust triangle-triangle overlap test using
// orientation predicates", Journal of Graphics Tools 8, 2003: nothing but signs of determinants is asked for.
#include "triangle_meeting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "exact_predicates.h"

namespace mlsmesh::core {
namespace {

using Corners = std::array<const Vec3*, 3>;

// Two triangles whose first `shared` corners are common, pairwise.
struct Pair {
  Corners a, b;
  int shared = 0;
};

Pair matched(const std::vector<Vec3>& position, const Triangle& first, const Triangle& second) {
  Pair pair;
  for (int i = 0; i < 3; ++i) {
    pair.a[i] = &position[first[i]];
    pair.b[i] = &position[second[i]];
  }
  for (int i = 0; i < 3; ++i) {
    for (int j = pair.shared; j < 3; ++j) {
      if (pair.a[i] != pair.b[j] && ((*pair.a[i])[0] != (*pair.b[j])[0] || *pair.a[i] != *pair.b[j]))
        continue;
      std::swap(pair.a[i], pair.a[pair.shared]);
      std::swap(pair.b[j], pair.b[pair.shared]);
      ++pair.shared;
      break;
    }
  }
  return pair;
}

// An axis along which the triangle is not seen as a line.
int goodAxis(const Corners& t) {
  const int widest = widestAxis(*t[0], *t[1], *t[2]);
  for (int i = 0; i < 2; ++i) {
    const int axis = (widest + i) % 3;
    if (orientationAlong(axis, *t[0], *t[1], *t[2]) != 0) return axis;
  }
  return (widest + 2) % 3;
}

bool mixed(int a, int b, int c) {
  return std::min({a, b, c}) < 0 && std::max({a, b, c}) > 0;
}

bool isBetween(const Vec3& p, const Vec3& q, const Vec3& x, int axis) {
  for (int i = 0; i < 3; ++i) {
    if (i != axis && (x[i] < std::min(p[i], q[i]) || x[i] > std::max(p[i], q[i]))) return false;
  }
  return true;
}

bool segmentsMeetAlong(int axis, const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  const int pa = orientationAlong(axis, p, q, a), pb = orientationAlong(axis, p, q, b);
  const int ap = orientationAlong(axis, a, b, p), aq = orientationAlong(axis, a, b, q);
  if (pa * pb < 0 && ap * aq < 0) return true;
  return (pa == 0 && isBetween(p, q, a, axis)) || (pb == 0 && isBetween(p, q, b, axis)) ||
         (ap == 0 && isBetween(a, b, p, axis)) || (aq == 0 && isBetween(a, b, q, axis));
}

// A segment in the triangle's plane.
bool coplanarSegmentMeets(const Corners& t, const Vec3& p, const Vec3& q) {
  const int axis = goodAxis(t);
  for (int i = 0; i < 3; ++i) {
    if (segmentsMeetAlong(axis, p, q, *t[i], *t[(i + 1) % 3])) return true;
  }
  const auto side = [&](int i) { return orientationAlong(axis, *t[i], *t[(i + 1) % 3], p); };
  return !mixed(side(0), side(1), side(2));
}

// `at_p` and `at_q` are the sides of the triangle's plane that the ends of the segment lie on.
bool segmentMeets(const Corners& t, const Vec3& p, const Vec3& q, int at_p, int at_q) {
  if (at_p * at_q > 0) return false;
  if (at_p == 0 && at_q == 0) return coplanarSegmentMeets(t, p, q);
  const auto side = [&](int i) { return orientation(p, q, *t[i], *t[(i + 1) % 3]); };
  return !mixed(side(0), side(1), side(2));
}

bool meetBesideEdge(const Pair& pair, int axis) {
  const Vec3 &s = *pair.a[0], &r = *pair.a[1], &x = *pair.a[2], &y = *pair.b[2];
  if (clearOrientationAlong(axis, s, r, x) * clearOrientationAlong(axis, s, r, y) < 0) return false;
  if (orientation(s, r, x, y) != 0) return false;
  const int plane_axis = goodAxis(pair.a);
  return orientationAlong(plane_axis, s, r, x) * orientationAlong(plane_axis, s, r, y) > 0;
}

// Whether, seen along the axis, a side of the first triangle at the common corner has the second strictly
// beyond its line for certain.
bool isPartedAtCorner(const Corners& a, const Corners& b, int axis) {
  const int turn = clearOrientationAlong(axis, *a[0], *a[1], *a[2]);
  const auto isBeyond = [&](int i, int side) {
    return clearOrientationAlong(axis, *a[0], *a[i], *b[1]) == side &&
           clearOrientationAlong(axis, *a[0], *a[i], *b[2]) == side;
  };
  return turn != 0 && (isBeyond(1, -turn) || isBeyond(2, turn));
}

// Whether the sides opposite to the common corner meet the other triangle; no other points can be common
// without one of these.
bool meetBesideCorner(const Corners& a, const Corners& b, int axis) {
  if (isPartedAtCorner(a, b, axis) || isPartedAtCorner(b, a, axis)) return false;
  const int a_1 = orientation(*b[0], *b[1], *b[2], *a[1]), a_2 = orientation(*b[0], *b[1], *b[2], *a[2]);
  if (a_1 * a_2 > 0) return false;
  const int b_1 = orientation(*a[0], *a[1], *a[2], *b[1]), b_2 = orientation(*a[0], *a[1], *a[2], *b[2]);
  return segmentMeets(b, *a[1], *a[2], a_1, a_2) || segmentMeets(a, *b[1], *b[2], b_1, b_2);
}

// Whether, seen along the axis, a side of one of the triangles has the other beyond it for certain.
bool isPartedBySide(const Corners& a, const Corners& b, int axis) {
  const int turn = clearOrientationAlong(axis, *a[0], *a[1], *a[2]);
  if (turn == 0) return false;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &p = *a[i], &q = *a[(i + 1) % 3];
    if (std::all_of(b.begin(), b.end(),
                    [&](const Vec3* x) { return clearOrientationAlong(axis, p, q, *x) == -turn; })) {
      return true;
    }
  }
  return false;
}

using Sides = std::array<int, 3>;

Sides sidesOf(const Corners& plane, const Corners& t) {
  Sides sides;
  for (int i = 0; i < 3; ++i) sides[i] = orientation(*plane[0], *plane[1], *plane[2], *t[i]);
  return sides;
}

bool areOneSided(const Sides& s) {
  return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
}

bool anySideMeets(const Corners& of, const Sides& sides, const Corners& t) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (segmentMeets(t, *of[i], *of[j], sides[i], sides[j])) return true;
  }
  return false;
}

bool meetApart(const Corners& a, const Corners& b, int axis) {
  if (isPartedBySide(a, b, axis) || isPartedBySide(b, a, axis)) return false;
  const Sides of_a = sidesOf(b, a);
  if (areOneSided(of_a)) return false;
  const Sides of_b = sidesOf(a, b);
  if (areOneSided(of_b)) return false;
  return anySideMeets(a, of_a, b) || anySideMeets(b, of_b, a);
}

}  // namespace

int widestAxis(const Vec3& a, const Vec3& b, const Vec3& c) {
  int axis;
  (b - a).cross(c - a).cwiseAbs().maxCoeff(&axis);
  return axis;
}

bool doubleAnEdge(const std::vector<Vec3>& position, const Triangle& first, const Triangle& second) {
  int same_places = 0, same_vertices = 0;
  for (const Index u : first) {
    for (const Index v : second) {
      same_vertices += u == v ? 1 : 0;
      same_places += position[u] == position[v] ? 1 : 0;
    }
  }
  return same_places >= 2 && same_places > same_vertices;
}

bool trianglesMeet(const std::vector<Vec3>& position, const Triangle& first, const Triangle& second,
                   int axis) {
  const Pair pair = matched(position, first, second);
  switch (pair.shared) {
    case 0:
      return meetApart(pair.a, pair.b, axis);
    case 1:
      return meetBesideCorner(pair.a, pair.b, axis);
    case 2:
      return meetBesideEdge(pair, axis);
    default:
      return false;
  }
}

}  // namespace mlsmesh::core

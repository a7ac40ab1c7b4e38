// SPDX-License-Identifier: BSD-3-Clause
// Departure from B. Mederos, L. Velho, L. H. de Figueiredo (SIBGRAPI 2003, section 2.3): the front bends as
// far as it may to go on, which closes thin parts and ends in flaps along open borders. Refusing them while
// the front grows opens holes in the thin parts; afterwards they can be told from what the front needed.
#include "border_trim.h"

#include <algorithm>
#include <cmath>

#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr double kObtuse = -0.5;     // cosine of the widest angle of a flap, at most
constexpr double kStanding = 0.643;  // cosine of 50 degrees, between its normal and those of the surface

double cosineAt(const Vec3& apex, const Vec3& a, const Vec3& b) {
  return (a - apex).normalized().dot((b - apex).normalized());
}

bool isFlap(const Triangle& t, const std::vector<Vec3>& x, const std::vector<Vec3>& normal) {
  const auto& [a, b, c] = t;
  const Vec3 own = unitNormal(x[a], x[b], x[c]);
  for (const Index v : t) {
    if (!(std::abs(own.dot(normal[v])) < kStanding)) return false;
  }
  return std::min({cosineAt(x[a], x[b], x[c]), cosineAt(x[b], x[c], x[a]), cosineAt(x[c], x[a], x[b])}) <
         kObtuse;
}

// Whether nothing else changes when the triangle of this border half-edge goes.
bool isSpare(const HalfEdgeMesh& mesh, Index h) {
  return !mesh.isBorder(HalfEdgeMesh::next(h)) && !mesh.isBorder(HalfEdgeMesh::previous(h)) &&
         !mesh.isBorderVertex(mesh.opposite(h));
}

}  // namespace

Index trimFlaps(HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const std::vector<Vec3>& normal,
                const Context& context) {
  CancelCheck check(context);
  std::vector<Index> open;
  for (Index h = 0; h < 3 * mesh.slotCount(); ++h) {
    check();
    if (mesh.alive(HalfEdgeMesh::triangleOf(h)) && mesh.isBorder(h)) open.push_back(h);
  }
  Index removed = 0;
  for (std::size_t i = 0; i < open.size(); ++i) {
    const Index t = HalfEdgeMesh::triangleOf(open[i]);
    if (!mesh.alive(t) || !isFlap(mesh.corners(t), points, normal) || !isSpare(mesh, open[i])) continue;
    Index around[3];
    for (int k = 0; k < 3; ++k) around[k] = mesh.twin(3 * t + k);
    mesh.removeTriangle(t);
    ++removed;
    for (const Index h : around) {
      if (h != kNone) open.push_back(h);
    }
  }
  return removed;
}

}  // namespace mlsmesh::core

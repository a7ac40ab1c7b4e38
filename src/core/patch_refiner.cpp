// SPDX-License-Identifier: BSD-3-Clause
// This work is based on P. Liepa, "Filling holes in meshes", SGP 2003: a triangle gets a vertex in its middle
// where that is farther from its corners than the edge length asked for there and at the corners; edges are
// relaxed in between. Departure: edges between two vertices of the rim are split, so that the patch can leave
// the plane of a flat rim everywhere.
#include "patch_refiner.h"

#include <algorithm>
#include <cmath>

#include "overlap_tests.h"

namespace mlsmesh::core {
namespace {

constexpr double kDensity = 1.4142135623730951;  // Liepa's alpha
constexpr std::size_t kMostVertices = 50000;
constexpr std::size_t kFewVertices = 500;  // that any patch may have
constexpr int kFlipRounds = 20;
constexpr double kHalfTurn = 3.14159265358979323846 + 1e-6;

double angleAt(const Vec3& apex, const Vec3& a, const Vec3& b) {
  return std::atan2((a - apex).cross(b - apex).norm(), (a - apex).dot(b - apex));
}

double meanEdge(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index vertex, Index end) {
  double sum = 0;
  int count = 0;
  for (Index h = mesh.firstOutgoing(vertex); h != kNone; h = mesh.nextOutgoing(h)) {
    if (HalfEdgeMesh::triangleOf(h) >= end) continue;
    for (const Index other : {mesh.target(h), mesh.opposite(h)}) {
      sum += (points[other] - points[vertex]).norm();
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

}  // namespace

PatchRefiner::PatchRefiner(HalfEdgeMesh& mesh, std::vector<Vec3>& points, PatchRange range,
                           const std::vector<Index>& rim)
    : mesh_(mesh),
      points_(points),
      range_(range),
      most_vertices_(static_cast<Index>(std::min(kMostVertices, kFewVertices + rim.size() * rim.size()))) {
  double mean = 0;
  for (const Index v : rim) {
    const double size = meanEdge(mesh, points, v, range.first_triangle);
    rim_size_[v] = size;
    mean += size / static_cast<double>(rim.size());
  }
  own_size_.assign(points.size() - static_cast<std::size_t>(range.first_vertex), mean);
}

double PatchRefiner::sizeAt(Index vertex) const {
  return isOwn(vertex) ? own_size_[vertex - range_.first_vertex] : rim_size_.at(vertex);
}

Index PatchRefiner::addVertex(const Vec3& point, double size) {
  points_.push_back(point);
  own_size_.push_back(size);
  return mesh_.addVertex();
}

void PatchRefiner::splitChords() {
  for (Index h = 3 * range_.first_triangle; h < 3 * mesh_.slotCount(); ++h) {
    if (!mesh_.alive(HalfEdgeMesh::triangleOf(h)) || mesh_.isBorder(h)) continue;
    const Index g = mesh_.twin(h), u = mesh_.origin(h), v = mesh_.target(h);
    if (g < 3 * range_.first_triangle || isOwn(u) || isOwn(v)) continue;
    const Index w = mesh_.opposite(h), x = mesh_.opposite(g);
    const Index middle = addVertex(0.5 * (points_[u] + points_[v]), 0.5 * (sizeAt(u) + sizeAt(v)));
    mesh_.removeTriangle(HalfEdgeMesh::triangleOf(h));
    mesh_.removeTriangle(HalfEdgeMesh::triangleOf(g));
    mesh_.addTriangle(u, middle, w);
    mesh_.addTriangle(middle, v, w);
    mesh_.addTriangle(v, middle, x);
    mesh_.addTriangle(middle, u, x);
  }
}

bool PatchRefiner::divide() {
  const std::size_t before = points_.size();
  flipToDelaunay();
  while (divideOnce()) flipToDelaunay();
  return points_.size() > before;
}

bool PatchRefiner::divideOnce() {
  const std::size_t before = points_.size();
  const Index end = mesh_.slotCount();
  for (Index t = range_.first_triangle; t < end; ++t) {
    if (!mesh_.alive(t)) continue;
    if (mesh_.vertexCount() - range_.first_vertex >= most_vertices_) break;
    const auto [a, b, c] = mesh_.corners(t);
    const Vec3 middle = (points_[a] + points_[b] + points_[c]) / 3;
    const double size = (sizeAt(a) + sizeAt(b) + sizeAt(c)) / 3;
    if (!isTooLarge({a, b, c}, size, middle)) continue;
    const Index center = addVertex(middle, size);
    mesh_.removeTriangle(t);
    mesh_.addTriangle(a, b, center);
    mesh_.addTriangle(b, c, center);
    mesh_.addTriangle(c, a, center);
  }
  return points_.size() > before;
}

bool PatchRefiner::isTooLarge(const Triangle& corners, double size, const Vec3& middle) const {
  return std::all_of(corners.begin(), corners.end(), [&](Index v) {
    return kDensity * (points_[v] - middle).norm() > std::max(size, sizeAt(v));
  });
}

void PatchRefiner::flipToDelaunay() {
  for (int round = 0; round < kFlipRounds; ++round) {
    bool flipped = false;
    for (Index h = 3 * range_.first_triangle; h < 3 * mesh_.slotCount(); ++h) {
      if (!mesh_.alive(HalfEdgeMesh::triangleOf(h))) continue;
      const Index g = mesh_.twin(h);
      if (g < 3 * range_.first_triangle || g < h) continue;
      if (!isDelaunay(h) && mayFlip(h) && mesh_.flip(h)) flipped = true;
    }
    if (!flipped) return;
  }
}

bool PatchRefiner::isDelaunay(Index half_edge) const {
  const Vec3 &u = points_[mesh_.origin(half_edge)], &v = points_[mesh_.target(half_edge)];
  const Vec3 &w = points_[mesh_.opposite(half_edge)], &x = points_[mesh_.opposite(mesh_.twin(half_edge))];
  return angleAt(w, u, v) + angleAt(x, u, v) <= kHalfTurn;
}

bool PatchRefiner::mayFlip(Index half_edge) const {
  const Index u = mesh_.origin(half_edge), v = mesh_.target(half_edge);
  const Index w = mesh_.opposite(half_edge), x = mesh_.opposite(mesh_.twin(half_edge));
  if (!isOwn(w) && !isOwn(x)) return false;
  if (mesh_.degree(u) <= 3 || mesh_.degree(v) <= 3) return false;
  return !isDegenerate(points_[x], points_[w], points_[u]) &&
         !isDegenerate(points_[w], points_[x], points_[v]);
}

}  // namespace mlsmesh::core

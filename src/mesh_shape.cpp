// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_shape.h"

#include <algorithm>
#include <cmath>

#include "core/exact_predicates.h"
#include "edge_table.h"
#include "mlsmesh/core/parallel.h"

namespace mlsmesh {

namespace {

using core::Index;
using core::Triangle;
using core::Vec3;

constexpr double kDegrees = 180 / 3.14159265358979323846;
constexpr double kFolded = 30, kFlipped = 5;
constexpr std::size_t kBlock = 16384;

/// 0 if one of them has no length.
double angleBetween(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b) + 0.0) * kDegrees;  // -0 would stand for 180
}

/// With r = area / half perimeter and R = product of the sides / (4 area).
double qualityOf(double area, double x, double y, double z) {
  const double product = x * y * z * (x + y + z);
  return product > 0 ? std::min(1.0, 16 * area * area / product) : 0;
}

/// One value a triangle.
struct TriangleFigures {
  std::vector<double> quality, smallest_angle, largest_angle;

  explicit TriangleFigures(std::size_t count) : quality(count), smallest_angle(count), largest_angle(count) {}

  void measure(std::size_t triangle, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a, bc = c - b, ca = a - c;
    quality[triangle] = qualityOf(0.5 * ab.cross(ca).norm(), ab.norm(), bc.norm(), ca.norm());
    const auto angles = {angleBetween(ab, -ca), angleBetween(bc, -ab), angleBetween(ca, -bc)};
    smallest_angle[triangle] = std::min(angles);
    largest_angle[triangle] = std::max(angles);
  }
};

/// The angle between the two faces of an edge; kUnknown where one of them is degenerate.
double dihedralAt(const std::vector<Vec3>& vertices, const EdgeTable& edges, Index edge) {
  const Index h = edges.halfEdge(edge, 0), g = edges.halfEdge(edge, 1);
  const Vec3 &from = vertices[edges.origin(h)], &to = vertices[edges.target(h)];
  const Vec3 &first = vertices[edges.opposite(h)], &second = vertices[edges.opposite(g)];
  if (core::areCollinear(from, to, first) || core::areCollinear(from, to, second)) return kUnknown;
  const Vec3 along = (to - from).normalized();
  const auto heightOf = [&](const Vec3& apex) -> Vec3 {
    const Vec3 side = apex - from;
    return side - along * along.dot(side);
  };
  return angleBetween(heightOf(first), heightOf(second));
}

void measureEdges(const std::vector<Vec3>& vertices, const EdgeTable& edges, const core::Context& context,
                  MeshShape& shape) {
  const auto count = static_cast<std::size_t>(edges.edgeCount());
  std::vector<double> length(count), dihedral(count, kUnknown);
  parallelBlocks(context, count, kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto edge = static_cast<Index>(i);
      const Index h = edges.halfEdge(edge, 0);
      length[i] = (vertices[edges.target(h)] - vertices[edges.origin(h)]).norm();
      if (edges.facesAt(edge) == 2) dihedral[i] = dihedralAt(vertices, edges, edge);
    }
  });
  for (const double angle : dihedral) {
    if (std::isnan(angle)) continue;
    shape.smallest_dihedral = std::fmin(shape.smallest_dihedral, angle);
    shape.folded_edges += angle < kFolded;
    shape.flipped_edges += angle < kFlipped;
  }
  shape.edge_length = statisticsOf(std::move(length));
}

}  // namespace

double diagonalOf(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles) {
  Eigen::AlignedBox3d box;
  for (const Triangle& triangle : triangles)
    for (const Index corner : triangle) box.extend(vertices[corner]);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

MeshShape meshShape(const std::vector<Vec3>& vertices, const std::vector<Triangle>& triangles,
                    const core::Context& context) {
  const auto vertex_count = static_cast<Index>(vertices.size());
  const std::vector<Triangle> faces = facesWithThreeCorners(triangles, vertex_count);
  MeshShape shape;
  TriangleFigures figures(faces.size());
  parallelBlocks(context, faces.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      figures.measure(i, vertices[faces[i][0]], vertices[faces[i][1]], vertices[faces[i][2]]);
  });
  for (const auto& [a, b, c] : faces)
    shape.area += 0.5 * (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]).norm();
  shape.quality = statisticsOf(std::move(figures.quality));
  shape.smallest_angle = statisticsOf(std::move(figures.smallest_angle));
  shape.largest_angle = statisticsOf(std::move(figures.largest_angle));
  shape.diagonal = diagonalOf(vertices, faces);
  measureEdges(vertices, EdgeTable(vertex_count, faces), context, shape);
  return shape;
}

}  // namespace mlsmesh

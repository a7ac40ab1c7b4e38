// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/shape.h"

#include "drawing/palette.h"

#include <algorithm>

namespace mlsmesh::apps {
namespace {

using core::Index;

std::vector<std::vector<Index>> neighborsIn(const std::vector<core::Triangle>& triangles, Index vertices) {
  std::vector<std::vector<Index>> neighbors(static_cast<std::size_t>(vertices));
  for (const core::Triangle& triangle : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      neighbors[triangle[i]].push_back(triangle[(i + 1) % 3]);
      neighbors[triangle[i]].push_back(triangle[(i + 2) % 3]);
    }
  }
  return neighbors;
}

/// A category for each vertex: of those that its neighbours have least, the one that was used least.
std::vector<int> colorVertices(const std::vector<std::vector<Index>>& neighbors) {
  std::vector<int> category(neighbors.size(), -1);
  std::array<std::size_t, kCategories> used{};
  for (std::size_t v = 0; v < neighbors.size(); ++v) {
    std::array<std::size_t, kCategories> around{};
    for (const Index other : neighbors[v])
      if (category[other] >= 0) ++around[category[other]];
    int best = 0;
    for (int c = 1; c < kCategories; ++c)
      if (std::pair(around[c], used[c]) < std::pair(around[best], used[best])) best = c;
    category[v] = best;
    ++used[best];
  }
  return category;
}

std::vector<core::Vec3> worldPoints(const core::PointSet& set, const std::vector<core::Vec3>& local,
                                    std::size_t count) {
  std::vector<core::Vec3> world;
  world.reserve(count);
  for (std::size_t i = 0; i < count; ++i) world.push_back(set.world(local[i]));
  return world;
}

}  // namespace

Shape levelShape(const core::Reconstruction& reconstruction, Index level) {
  const core::RefinedMesh& mesh = reconstruction.mesh;
  const auto count = static_cast<std::size_t>(mesh.level_vertices[level]);
  Shape shape;
  shape.points = worldPoints(reconstruction.points, mesh.position, count);
  shape.triangles = mesh.level_triangles[level];
  shape.normals = core::vertexNormals(shape.triangles, shape.points);
  return shape;
}

Shape representativesShape(const core::Reconstruction& reconstruction) {
  const core::RefinedMesh& mesh = reconstruction.mesh;
  const auto count = static_cast<std::size_t>(mesh.level_vertices.front());
  Shape shape;
  shape.points = worldPoints(reconstruction.points, mesh.position, count);
  shape.normals.assign(mesh.normal.begin(), mesh.normal.begin() + static_cast<std::ptrdiff_t>(count));
  return shape;
}

Shape clustersShape(const core::Reconstruction& reconstruction) {
  const core::RefinedMesh& mesh = reconstruction.mesh;
  const core::PointSet& points = reconstruction.points;
  Shape shape;
  shape.points = worldPoints(points, points.position, points.position.size());
  shape.colors.assign(shape.points.size(), kNoCategoryColor);
  const std::vector<int> category =
      colorVertices(neighborsIn(mesh.level_triangles.front(), mesh.level_vertices.front()));
  const core::IndexLists& clusters = reconstruction.clusters;
  const Index count = std::min(clusters.count(), mesh.level_vertices.front());
  for (Index cluster = 0; cluster < count; ++cluster)
    for (Index i = 0; i < clusters.size(cluster); ++i)
      shape.colors[clusters.data(cluster)[i]] = categoryColor(category[cluster]);
  return shape;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/mesh_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/triangle_tree.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/parallel.h"
#include "mlsmesh/mesh_shape.h"
#include "mlsmesh/mesh_welding.h"
#include "surface_samples.h"

namespace mlsmesh {

namespace {

using core::Index;
using core::TriangleTree;
using core::Vec3;

constexpr std::size_t kBlock = 1024;
constexpr double kUncovered = 0.005;  // of the diagonal
constexpr double kUnsupported = 5;    // spacings
constexpr double kDegrees = 180 / 3.14159265358979323846;

/// Distances of points from a mesh, and the triangles that they are from.
struct Nearest {
  std::vector<double> distance;
  std::vector<Index> triangle;
};

Nearest nearestTriangles(const std::vector<Vec3>& points, const TriangleTree& tree,
                         const core::Context& context) {
  Nearest nearest;
  nearest.distance.resize(points.size());
  nearest.triangle.resize(points.size());
  parallelBlocks(context, points.size(), kBlock, [&](std::size_t first, std::size_t last) {
    Index hint = core::kNone;  // points of a file are often beside one another
    for (std::size_t i = first; i < last; ++i) {
      const TriangleTree::Nearest found = tree.nearest(points[i], hint);
      hint = found.triangle;
      nearest.distance[i] = std::sqrt(found.squared_distance);
      nearest.triangle[i] = found.triangle;
    }
  });
  return nearest;
}

std::vector<double> distancesToPoints(const std::vector<Vec3>& from, const core::NeighborSearch& points,
                                      const core::Context& context) {
  std::vector<double> distance(from.size());
  parallelBlocks(context, from.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      Index nearest = core::kNone;
      double squared = 0;
      points.nearest(from[i], 1, &nearest, &squared);
      distance[i] = std::sqrt(squared);
    }
  });
  return distance;
}

std::vector<Vec3> finiteOf(const std::vector<Vec3>& points) {
  std::vector<Vec3> finite;
  finite.reserve(points.size());
  std::copy_if(points.begin(), points.end(), std::back_inserter(finite),
               [](const Vec3& point) { return point.allFinite(); });
  return finite;
}

std::vector<Vec3> distinctOf(const std::vector<Vec3>& points) {
  std::vector<Vec3> distinct(points);
  std::vector<core::Triangle> none;
  weldVertices(distinct, none);
  return distinct;
}

double diagonalOf(const std::vector<Vec3>& points) {
  Eigen::AlignedBox3d box;
  for (const Vec3& point : points) box.extend(point);
  return box.diagonal().norm();
}

/// The vertices that are corners of triangles.
std::vector<Vec3> verticesInUse(const SoupView& mesh) {
  std::vector<char> used(mesh.vertices.size(), 0);
  for (const core::Triangle& triangle : mesh.triangles)
    for (const Index corner : triangle) used[corner] = 1;
  std::vector<Vec3> vertices;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (used[v] != 0) vertices.push_back(mesh.vertices[v]);
  return vertices;
}

/// Of no length if the triangle is degenerate.
Vec3 normalOf(const SoupView& mesh, Index triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3 normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
  const double length = normal.norm();
  return length > 0 ? Vec3(normal / length) : Vec3(0, 0, 0);
}

/// Compares normals at points of both surfaces.
class NormalComparison {
 public:
  void add(const SoupView& from, const SurfaceSamples& samples, const SoupView& to, const Nearest& nearest) {
    for (std::size_t i = 0; i < samples.position.size(); ++i) {
      const double cosine = normalOf(from, samples.triangle[i]).dot(normalOf(to, nearest.triangle[i]));
      const double size = std::min(1.0, std::abs(cosine));
      cosines_ += size;
      same_side_ += cosine > 0;
      angles_.push_back(std::acos(size) * kDegrees);
    }
  }
  void report(SurfaceDistances& result) const {
    const auto count = static_cast<double>(angles_.size());
    result.normal_consistency = cosines_ / count;
    result.same_side = static_cast<double>(same_side_) / count;
    result.normal_error = statisticsOf(angles_);
  }

 private:
  double cosines_ = 0;
  std::size_t same_side_ = 0;
  std::vector<double> angles_;
};

FScore fScore(double tolerance, double precision, double recall) {
  const double sum = precision + recall;
  return {tolerance, precision, recall, sum > 0 ? 2 * precision * recall / sum : 0};
}

double greatest(const std::vector<double>& distances) {
  return distances.empty() ? 0 : *std::max_element(distances.begin(), distances.end());
}

/// One direction: points on a surface, and what is nearest to them on the other one.
struct Direction {
  SurfaceSamples samples;
  Nearest nearest;
  Statistics statistics;
  double greatest_of_vertices = 0;

  Direction(const SoupView& from, SurfaceSamples points, const TriangleTree& to, const core::Context& context)
      : samples(std::move(points)),
        nearest(nearestTriangles(samples.position, to, context)),
        statistics(statisticsOf(nearest.distance)),
        greatest_of_vertices(greatest(nearestTriangles(verticesInUse(from), to, context).distance)) {}
};

void combine(const Direction& there, const Direction& back, SurfaceDistances& result) {
  const Statistics &a = there.statistics, &b = back.statistics;
  result.mesh_to_truth = a;
  result.truth_to_mesh = b;
  result.mean = (a.mean + b.mean) / 2;
  result.rms = std::sqrt((a.rms * a.rms + b.rms * b.rms) / 2);
  result.hausdorff = std::max({a.max, b.max, there.greatest_of_vertices, back.greatest_of_vertices});
  for (FScore& score : result.f_scores) {
    const double limit = score.tolerance * result.diagonal;
    score = fScore(score.tolerance, 1 - shareAbove(there.nearest.distance, limit),
                   1 - shareAbove(back.nearest.distance, limit));
  }
}

}  // namespace

CloudDistances measureCloud(const std::vector<Vec3>& points, const SoupView& mesh, std::size_t samples,
                            const core::Context& context) {
  if (points.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    throw core::Failure(StatusCode::IndexOverflow, "the cloud has more points than 32-bit indices can name");
  const std::vector<Vec3> finite = finiteOf(points);
  if (finite.empty()) throw core::Failure(StatusCode::EmptyInput, "the cloud has no finite point");
  CloudDistances result;
  result.points = static_cast<Index>(finite.size());
  result.non_finite = static_cast<Index>(points.size() - finite.size());
  result.diagonal = diagonalOf(finite);
  const std::vector<Vec3> distinct = distinctOf(finite);
  const std::unique_ptr<core::NeighborSearch> search = core::makeKdTree(distinct, context);
  if (distinct.size() > 1) result.spacing = core::medianSpacing(distinct, *search, context);

  const TriangleTree tree(mesh.vertices, mesh.triangles);
  if (tree.empty()) return result;
  const std::vector<double> to_mesh = nearestTriangles(finite, tree, context).distance;
  result.cloud_to_mesh = statisticsOf(to_mesh);
  result.uncovered = shareAbove(to_mesh, kUncovered * result.diagonal);
  const SurfaceSamples surface = sampleSurface(mesh.vertices, mesh.triangles, samples);
  const std::vector<double> to_cloud = distancesToPoints(surface.position, *search, context);
  result.mesh_to_cloud = statisticsOf(to_cloud);
  if (distinct.size() > 1) result.unsupported = shareAbove(to_cloud, kUnsupported * result.spacing);
  return result;
}

std::vector<double> distancesFromMesh(const std::vector<Vec3>& points, const SoupView& mesh,
                                      const core::Context& context) {
  const TriangleTree tree(mesh.vertices, mesh.triangles);
  if (tree.empty()) throw core::Failure(StatusCode::NoTriangles, "the mesh has no triangle");
  return nearestTriangles(points, tree, context).distance;
}

std::vector<double> distancesFromCloud(const std::vector<Vec3>& places, const std::vector<Vec3>& cloud,
                                       const core::Context& context) {
  if (cloud.empty()) throw core::Failure(StatusCode::EmptyInput, "the cloud has no point");
  return distancesToPoints(places, *core::makeKdTree(cloud, context), context);
}

SurfaceDistances measureSurface(const SoupView& mesh, const SoupView& truth, std::size_t samples,
                                const core::Context& context) {
  SurfaceSamples of_truth = sampleSurface(truth.vertices, truth.triangles, samples);
  if (of_truth.position.empty())
    throw core::Failure(StatusCode::NoTriangles, "the true surface has no triangle with an area");
  SurfaceDistances result;
  result.diagonal = diagonalOf(truth.vertices, truth.triangles);
  SurfaceSamples of_mesh = sampleSurface(mesh.vertices, mesh.triangles, samples);
  if (of_mesh.position.empty()) {
    for (FScore& score : result.f_scores) score = fScore(score.tolerance, 0, 0);
    return result;
  }
  const TriangleTree mesh_tree(mesh.vertices, mesh.triangles);
  const TriangleTree truth_tree(truth.vertices, truth.triangles);
  const Direction there(mesh, std::move(of_mesh), truth_tree, context);
  const Direction back(truth, std::move(of_truth), mesh_tree, context);
  combine(there, back, result);
  NormalComparison normals;
  normals.add(mesh, there.samples, truth, there.nearest);
  normals.add(truth, back.samples, mesh, back.nearest);
  normals.report(result);
  return result;
}

}  // namespace mlsmesh

// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/inspection.h"

#include "common/app_error.h"
#include "common/cloud_io.h"
#include "inspect/inspect_options.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/mesh_welding.h"
#include "mlsmesh/vertex_cloud.h"

#include <chrono>

namespace mlsmesh::apps {

namespace {

namespace fs = std::filesystem;

/// Runs `work`, whose failures are those of `file`.
void measuring(const fs::path& file, const std::function<void()>& work) {
  const Status status = core::guarded(work);
  if (!status.ok()) throw fileError(file.string(), status.message);
}

std::vector<core::Vec3> readPositions(const fs::path& file) {
  pcl::PCLPointCloud2 cloud;
  readCloud(file, cloud);
  core::StoredAs stored_as = core::StoredAs::Float;
  std::vector<core::Vec3> positions;
  measuring(file, [&] { positions = worldPositions(cloud, stored_as); });
  return positions;
}

TriangleFile readWelded(const fs::path& file, bool weld) {
  TriangleFile mesh = readTriangles(file);
  if (weld) mesh.welded_vertices += weldVertices(mesh.vertices, mesh.triangles);
  return mesh;
}

SoupView viewOf(const TriangleFile& mesh) {
  return {mesh.vertices, mesh.triangles};
}

void compareWithCloud(const InspectOptions& options, const core::Context& context, Inspection& result) {
  const std::vector<core::Vec3> points = readPositions(options.cloud);
  measuring(options.cloud,
            [&] { result.cloud = measureCloud(points, viewOf(result.mesh), options.samples, context); });
}

void compareWithTruth(const InspectOptions& options, const core::Context& context, Inspection& result) {
  const TriangleFile truth = readWelded(options.truth, options.weld);
  measuring(options.truth, [&] {
    result.truth = measureSurface(viewOf(result.mesh), viewOf(truth), options.samples, context);
    result.truth_topology = meshTopology(truth.vertices, truth.triangles);
  });
}

}  // namespace

Inspection inspect(const InspectOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  core::Context context;
  context.threads = options.threads;
  Inspection result;
  result.mesh = readWelded(options.mesh, options.weld);
  const TriangleFile& mesh = result.mesh;
  if (mesh.triangles.empty())
    printWarning(kInspectProgram, options.mesh.string() + ": holds no faces; is it a point cloud?");
  measuring(options.mesh, [&] {
    result.topology = meshTopology(mesh.vertices, mesh.triangles);
    result.self_intersections = countSelfIntersections(mesh.vertices, mesh.triangles, context);
    result.shape = meshShape(mesh.vertices, mesh.triangles, context);
  });
  if (!options.cloud.empty()) compareWithCloud(options, context, result);
  if (!options.truth.empty()) compareWithTruth(options, context, result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace mlsmesh::apps

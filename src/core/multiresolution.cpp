// SPDX-License-Identifier: BSD-3-Clause
// The pipeline of B. Mederos, L. Velho, L. H. de Figueiredo, "Moving least squares multiresolution surface
// approximation", SIBGRAPI 2003, section 2.
#include "mlsmesh/core/multiresolution.h"

#include <chrono>
#include <memory>
#include <utility>

#include "level_zero.h"
#include "mlsmesh/core/parameter_check.h"
#include "mlsmesh/core/self_intersections.h"
#include "reduction_stages.h"

namespace mlsmesh::core {
namespace {

// Times the stages one after the other and tells the progress handle which one runs.
class Stopwatch {
 public:
  Stopwatch(const Context& context, std::vector<StageTime>& stages)
      : context_(context), progress_(context.progress), stages_(stages) {}

  template <typename Work>
  void run(const std::string& stage, double end, const Work& work) {
    progress_.enterStage(stage, end);
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    stages_.push_back({stage, seconds.count()});
    progress_.advance(1);
    context_.checkCancelled();
  }

 private:
  const Context& context_;
  Progress progress_;
  std::vector<StageTime>& stages_;
};

std::vector<MeshReport> reportLevels(const RefinedMesh& mesh, const Context& context) {
  std::vector<MeshReport> reports(static_cast<std::size_t>(mesh.levelCount()));
  for (std::size_t level = 0; level < reports.size(); ++level) {
    const bool finest = level + 1 == reports.size();
    const auto begin = mesh.position.begin();
    const std::vector<Vec3> vertices(begin, finest ? begin : begin + mesh.level_vertices[level]);
    reports[level] = reportTopology(finest ? mesh.position : vertices, mesh.level_triangles[level], context);
    std::optional<std::int64_t>& pairs = reports[level].self_intersections;
    pairs = mesh.level_intersections[level];
    if (!pairs) pairs = SelfIntersections(mesh.position, mesh.level_triangles[level], context).count();
  }
  return reports;
}

NoiseEstimate noiseOf(const Surroundings& cloud, double spacing, const MultiresolutionParameters& parameters,
                      const Context& context) {
  if (!parameters.noise.adapt || !parameters.reduce) return {};
  const double given = parameters.noise.sigma;
  if (given < 0) return estimateNoise(cloud.points.position, cloud.search(), context);
  return {given * spacing, given};
}

void denoise(const NoiseAdaptation& noise, const Context& context, Surroundings& cloud) {
  for (int pass = 0; pass < noise.passes; ++pass) {
    cloud.points.position =
        projectAll(cloud.points.position, cloud.search(), noise.denoising, noise.residual_limit, context);
    cloud.renewSearch();
  }
}

void reduce(Stopwatch& stages, Context& context, Surroundings& cloud, KnownNeighbors& neighbors,
            Reconstruction& result) {
  stages.run("reduction", 0.25, [&] { clusterAndReduce(cloud, context, result); });
  stages.run("outliers", 0.3, [&] {
    removeOutliers(context, cloud, neighbors, result);
    divideBetweenSheets(cloud, context, result);
  });
  stages.run("features", 0.35, [&] { keepFeatures(cloud, context, result); });
  if (result.noise.drops_crowded) dropCrowded(result.representatives, result.clusters, context);
}

}  // namespace

Reconstruction reconstruct(PointSet points, const SearchFactory& search_factory,
                           const MultiresolutionParameters& parameters, Context& context) {
  check(parameters);
  const SearchFactory makeSearch = search_factory ? search_factory : [&](const PointSet& set) {
    return makeKdTreeOver(set.position, context);
  };
  Reconstruction result;
  Stopwatch stages(context, result.stages);
  std::unique_ptr<Surroundings> cloud;
  stages.run("search", 0.05, [&] {
    cloud = std::make_unique<Surroundings>(std::move(points), makeSearch);
    result.spacing = medianSpacing(cloud->points.position, cloud->search(), context);
  });
  stages.run("noise", 0.1, [&] {
    result.noise = adaptTo(noiseOf(*cloud, result.spacing, parameters, context), parameters);
  });
  if (result.noise.passes > 0) stages.run("denoising", 0.2, [&] { denoise(result.noise, context, *cloud); });
  renewSurface(result.noise, *cloud);
  KnownNeighbors neighbors;
  if (result.noise.parameters.reduce) reduce(stages, context, *cloud, neighbors, result);
  stages.run("triangulation", result.noise.parameters.reduce ? 0.45 : 0.7,
             [&] { makeLevelZero(*cloud, context, std::move(neighbors), result); });
  if (parameters.watertight || parameters.hole_size > 0) {
    stages.run("holes", parameters.reduce ? 0.5 : 0.75, [&] { closeHolesOf(*cloud, context, result); });
  }
  const RefinementParameters& refinement = result.noise.parameters.refinement;
  const double begin = context.progress.fraction();
  for (int level = 1; level <= refinement.levels; ++level) {
    const double share = static_cast<double>(level) / refinement.levels;
    stages.run("refinement " + std::to_string(level), begin + share * (0.95 - begin), [&] {
      addLevel(cloud->points, cloud->surface(), result.spacing, refinement, context, result.mesh,
               result.features);
    });
  }
  result.points = std::move(cloud->points);
  cloud.reset();
  stages.run("report", 1.0, [&] { result.reports = reportLevels(result.mesh, context); });
  return result;
}

}  // namespace mlsmesh::core

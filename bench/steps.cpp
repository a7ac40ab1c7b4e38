// SPDX-License-Identifier: BSD-3-Clause
#include "steps.h"

#include <benchmark/benchmark.h>

#include <utility>

#include "flann_yardstick.h"
#include "mlsmesh/core/bsp_clustering.h"
#include "mlsmesh/core/outliers.h"

namespace mlsmesh::bench {
namespace {

using namespace core;

constexpr int kNeighbors = 16;

Context contextOf(int threads) {
  Context context;
  context.threads = threads;
  return context;
}

PointSet pointSetOf(const StepData& data, Context& context) {
  return makePointSet(data.world(), StoredAs::Float, nullptr, context);
}

Work pointSet(StepData& data, int threads) {
  return [&data, context = contextOf(threads)]() mutable -> std::size_t {
    return pointSetOf(data, context).position.size();
  };
}

Work kdTree(StepData& data, int) {
  return [&points = data.points().position]() -> std::size_t { return makeKdTree(points)->size(); };
}

Work nearest(StepData& data, int threads) {
  return [&points = data.points().position, &search = data.search(), context = contextOf(threads)] {
    NeighborTable table = nearestOfAll(points, search, kNeighbors, context);
    benchmark::DoNotOptimize(table.indices.data());
    return points.size();
  };
}

Work flannTreeAndNearest16(StepData& data, int) {
  return [&points = data.points().position] {
    benchmark::DoNotOptimize(flannTreeAndNearest(points, kNeighbors));
    return points.size();
  };
}

Work noise(StepData& data, int threads) {
  return [&points = data.points().position, &search = data.search(), context = contextOf(threads)] {
    benchmark::DoNotOptimize(estimateNoise(points, search, context).sigma);
    return points.size();
  };
}

Work projection(StepData& data, int threads) {
  return [&points = data.points().position, &search = data.search(), context = contextOf(threads)] {
    return projectAll(points, search, ProjectionParameters{}, 0, context).size();
  };
}

Work clustering(StepData& data, int threads) {
  return [&points = data.points().position, context = contextOf(threads)]() -> std::size_t {
    return clusterPoints(points, ClusteringParameters{}, context).count();
  };
}

Work reduction(StepData& data, int threads) {
  return [&points = data.points(), &surface = data.surface(), &clusters = data.clusters(),
          context = contextOf(threads)]() -> std::size_t {
    IndexLists changed = clusters;
    return reducePoints(points, surface, changed, ReductionParameters{}, context).size();
  };
}

Work outliers(StepData& data, int threads) {
  return [&points = data.points().position, &surface = data.surface(), &reduced = data.reduced(),
          context = contextOf(threads)] {
    StepData::Reduced kept = reduced;
    const auto search = makeKdTreeOver(kept.representatives.position);
    const NeighborTable neighbors = nearestOfAll(kept.representatives.position, *search, 12, context);
    const auto dropped = dropOutliers(OutlierParameters{}, neighbors, kept.representatives, kept.clusters);
    return dropped.size() + strayPoints(points, surface, kept.representatives, kept.clusters, context).size();
  };
}

Work features(StepData& data, int threads) {
  return [&points = data.points(), &search = data.search(), &reduced = data.reduced(),
          context = contextOf(threads)] {
    return detectFeatures(points, search, reduced.clusters, reduced.representatives.variation,
                          FeatureParameters{}, context)
        .vertices.size();
  };
}

Work triangulateRepresentatives(StepData& data, int threads) {
  return [&cloud = data.levelZero(), &search = data.levelZeroSearch(), context = contextOf(threads)] {
    TriangulationInput input{cloud.representatives.position};
    input.normals = &cloud.representatives.normal;
    input.cloud_spacing = &cloud.representatives.spacing;
    input.cloud = &search;
    input.cloud_points = &cloud.points.position;
    input.cloud_nearest = &cloud.representatives.nearest;
    input.spacing = cloud.spacing;
    input.may_split = true;
    return triangulate(input, TriangulationParameters{}, context).triangles.size();
  };
}

Work triangulateAllPoints(StepData& data, int threads) {
  return [&points = data.points().position, &search = data.search(), spacing = data.spacing(),
          context = contextOf(threads)] {
    TriangulationInput input{points};
    input.search = &search;
    input.spacing = spacing;
    input.may_split = true;
    return triangulate(input, TriangulationParameters{}, context).triangles.size();
  };
}

Work refinement(StepData& data, int threads) {
  return [&cloud = data.levelZero(), &surface = data.levelZeroSurface(), context = contextOf(threads)] {
    RefinedMesh mesh = cloud.mesh;
    addLevel(cloud.points, surface, cloud.spacing, cloud.noise.parameters.refinement, context, mesh,
             cloud.features);
    return mesh.level_triangles.back().size();
  };
}

Work report(StepData& data, int threads) {
  return [&mesh = data.levelZero().mesh, context = contextOf(threads)]() -> std::size_t {
    return reportMesh(mesh.position, mesh.level_triangles[0], context).triangles;
  };
}

Work pipeline(StepData& data, int threads, bool reduce, int levels) {
  MultiresolutionParameters parameters;
  parameters.reduce = reduce;
  parameters.refinement.levels = levels;
  return [&data, parameters, context = contextOf(threads)]() mutable {
    return reconstruct(pointSetOf(data, context), nullptr, parameters, context)
        .mesh.level_triangles.back()
        .size();
  };
}

Work levelZero(StepData& data, int threads) {
  return pipeline(data, threads, true, 0);
}
Work levelsZeroToTwo(StepData& data, int threads) {
  return pipeline(data, threads, true, 2);
}
Work noReduction(StepData& data, int threads) {
  return pipeline(data, threads, false, 0);
}

}  // namespace

const std::vector<Step>& steps() {
  static const std::vector<Step> all{
      {"point_set", "points", pointSet},
      {"kd_tree", "points", kdTree},
      {"nearest_16", "points", nearest},
      {"flann/tree_and_nearest_16", "points", flannTreeAndNearest16},
      {"noise", "points", noise},
      {"projection/all_points", "points", projection},
      {"clustering", "clusters", clustering},
      {"reduction", "representatives", reduction},
      {"outliers", "outliers", outliers},
      {"features", "crease_vertices", features},
      {"triangulation/representatives", "triangles", triangulateRepresentatives},
      {"triangulation/all_points", "triangles", triangulateAllPoints},
      {"refinement/level_1", "triangles", refinement},
      {"report/level_0", "triangles", report},
      {"pipeline/level_0", "triangles", levelZero},
      {"pipeline/levels_0_to_2", "triangles", levelsZeroToTwo},
      {"pipeline/no_reduction", "triangles", noReduction},
  };
  return all;
}

}  // namespace mlsmesh::bench

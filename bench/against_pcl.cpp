// SPDX-License-Identifier: BSD-3-Clause
// bench_against_pcl CLOUD.pcd [Google Benchmark's options]: our whole pipeline (all levels, one thread) and
// PCL's normals + greedy projection triangulation on the same cloud in one process, file reading left out.
#include <benchmark/benchmark.h>
#include <pcl/common/io.h>
#include <pcl/features/normal_3d.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <cstdio>
#include <string>

#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/point_set.h"
#include "mlsmesh/mls_multiresolution.h"

namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using CloudWithNormals = pcl::PointCloud<pcl::PointNormal>;

void ours(benchmark::State& state, const Cloud::Ptr& cloud, bool reduce, int levels) {
  std::size_t triangles = 0;
  for (auto _ : state) {
    mlsmesh::MlsMultiresolution<pcl::PointXYZ> pipeline;
    pipeline.setInputCloud(cloud);
    pipeline.setNumberOfThreads(1);
    pipeline.parameters().reduce = reduce;
    pipeline.setLevels(levels);
    pcl::PolygonMesh mesh;
    pipeline.compute(mesh);
    if (!pipeline.status().ok()) state.SkipWithError(pipeline.status().message.c_str());
    triangles = mesh.polygons.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
}

// Mean distance to the nearest other point, from which a user of PCL picks the radius.
double meanSpacing(const Cloud& cloud) {
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(cloud.makeShared());
  pcl::Indices indices(2);
  std::vector<float> squared(2);
  double sum = 0;
  for (const auto& point : cloud) {
    tree.nearestKSearch(point, 2, indices, squared);
    sum += std::sqrt(squared[1]);
  }
  return sum / static_cast<double>(cloud.size());
}

// Normals from 20 neighbours, radius of 5 spacings, the tutorial's angles.
void normalsAndGreedyProjection(benchmark::State& state, const Cloud::Ptr& cloud, double spacing) {
  std::size_t triangles = 0;
  for (auto _ : state) {
    pcl::NormalEstimation<pcl::PointXYZ, pcl::PointNormal> estimation;
    estimation.setInputCloud(cloud);
    estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
    estimation.setKSearch(20);
    CloudWithNormals::Ptr points(new CloudWithNormals);
    estimation.compute(*points);
    for (std::size_t i = 0; i < points->size(); ++i)
      (*points)[i].getVector3fMap() = (*cloud)[i].getVector3fMap();
    pcl::GreedyProjectionTriangulation<pcl::PointNormal> greedy;
    greedy.setSearchRadius(5 * spacing);
    greedy.setMu(2.5);
    greedy.setMaximumNearestNeighbors(100);
    greedy.setMaximumSurfaceAngle(M_PI / 4);
    greedy.setMinimumAngle(M_PI / 18);
    greedy.setMaximumAngle(2 * M_PI / 3);
    greedy.setInputCloud(points);
    greedy.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
    pcl::PolygonMesh mesh;
    greedy.reconstruct(mesh);
    triangles = mesh.polygons.size();
  }
  state.counters["triangles"] = static_cast<double>(triangles);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  Cloud::Ptr cloud(new Cloud);
  if (argc != 2 || pcl::io::loadPCDFile(argv[1], *cloud) < 0) {
    std::fprintf(stderr, "usage: bench_against_pcl CLOUD.pcd [--benchmark_repetitions=5 ...]\n");
    return 2;
  }
  const double spacing = meanSpacing(*cloud);
  const auto unit = benchmark::kMillisecond;
  benchmark::RegisterBenchmark("mlsmesh/levels_0_to_2", ours, cloud, true, 2)->Unit(unit);
  benchmark::RegisterBenchmark("mlsmesh/level_0", ours, cloud, true, 0)->Unit(unit);
  benchmark::RegisterBenchmark("mlsmesh/no_reduction", ours, cloud, false, 0)->Unit(unit);
  benchmark::RegisterBenchmark("pcl/normals_and_gp3", normalsAndGreedyProjection, cloud, spacing)->Unit(unit);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

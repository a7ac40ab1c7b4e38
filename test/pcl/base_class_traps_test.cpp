// SPDX-License-Identifier: BSD-3-Clause
// What PCL's base classes would do wrong if the verbs were left to them.
#include "clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/bsp_clustering.h"
#include "mlsmesh/mls_multiresolution.h"
#include "mlsmesh/mls_reduction.h"
#include "mlsmesh/mls_refinement.h"
#include "mlsmesh/mls_surface.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>
#include <pcl/search/kdtree.h>

#include <limits>
#include <memory>
#include <type_traits>
#include <vector>

namespace mlsmesh::testing {
namespace {

using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Clustering = BspClustering<Point>;
using Reduction = MlsReduction<Point, pcl::PointNormal>;
using Triangulation = AdvancingFrontTriangulation<Point>;
using Refinement = MlsRefinement<Point>;
using Multiresolution = MlsMultiresolution<Point>;

static_assert(!std::is_copy_constructible_v<Clustering> && !std::is_copy_assignable_v<Clustering>);
static_assert(!std::is_copy_constructible_v<Reduction> && !std::is_copy_assignable_v<Reduction>);
static_assert(!std::is_copy_constructible_v<Triangulation> && !std::is_copy_assignable_v<Triangulation>);
static_assert(!std::is_copy_constructible_v<Refinement> && !std::is_copy_assignable_v<Refinement>);
static_assert(!std::is_copy_constructible_v<Multiresolution> && !std::is_copy_assignable_v<Multiresolution>);
static_assert(!std::is_copy_constructible_v<MlsSurface<Point>> &&
              !std::is_copy_assignable_v<MlsSurface<Point>>);

// A coarse closed mesh with `vertices` on the unit sphere.
pcl::PolygonMesh::Ptr sphereMesh(int vertices) {
  Triangulation triangulation;
  triangulation.setInputCloud(cloudOf<Point>(spherePoints(vertices)));
  pcl::PolygonMesh::Ptr mesh(new pcl::PolygonMesh);
  triangulation.reconstruct(*mesh);
  EXPECT_TRUE(triangulation.status().ok()) << triangulation.status().message;
  return mesh;
}

// Every verb of every class on one input: its status, and that its outputs are well formed and empty if it
// failed.
struct Outcome {
  const char* verb;
  StatusCode code;
  bool empty;
};

std::vector<Outcome> runAll(const Cloud::ConstPtr& cloud, const pcl::IndicesPtr& indices,
                            const pcl::PolygonMesh::ConstPtr& mesh) {
  std::vector<Outcome> outcomes;
  const auto prepare = [&](auto& step) {
    if (cloud) step.setInputCloud(cloud);
    if (indices) step.setIndices(indices);
  };
  const auto note = [&](const char* verb, const auto& step, bool empty) {
    outcomes.push_back({verb, step.status().code, empty});
  };
  Clustering clustering;
  prepare(clustering);
  std::vector<pcl::PointIndices> clusters(3);
  clustering.extract(clusters);
  note("BspClustering::extract", clustering, clusters.empty());
  clusters.resize(3);
  clustering.compute(clusters);
  note("BspClustering::compute", clustering, clusters.empty());

  Reduction reduction;
  prepare(reduction);
  pcl::PointCloud<pcl::PointNormal> points;
  points.resize(4);
  reduction.process(points);
  note("MlsReduction::process", reduction, isEmpty(points));
  points.resize(4);
  static_cast<pcl::CloudSurfaceProcessing<Point, pcl::PointNormal>&>(reduction).process(points);
  note("CloudSurfaceProcessing::process", reduction, isEmpty(points));

  Triangulation triangulation;
  prepare(triangulation);
  pcl::PolygonMesh output = usedMesh();
  triangulation.compute(output);
  note("AdvancingFrontTriangulation::compute", triangulation, isEmpty(output));
  output = usedMesh();
  static_cast<pcl::PCLSurfaceBase<Point>&>(triangulation).reconstruct(output);
  note("PCLSurfaceBase::reconstruct", triangulation, isEmpty(output));
  std::vector<pcl::Vertices> polygons(2);
  static_cast<pcl::MeshConstruction<Point>&>(triangulation).reconstruct(polygons);
  note("MeshConstruction::reconstruct(polygons)", triangulation, polygons.empty());

  Refinement refinement;
  prepare(refinement);
  if (mesh) refinement.setInputMesh(mesh);
  output = usedMesh();
  refinement.process(output);
  note("MlsRefinement::process", refinement, isEmpty(output) && refinement.getLevelCount() == 0);

  Multiresolution multiresolution;
  prepare(multiresolution);
  output = usedMesh();
  multiresolution.compute(output);
  note("MlsMultiresolution::compute", multiresolution,
       isEmpty(output) && multiresolution.getLevelCount() == 0);
  Cloud vertices;
  vertices.resize(4);
  polygons.resize(2);
  static_cast<pcl::SurfaceReconstruction<Point>&>(multiresolution).reconstruct(vertices, polygons);
  note("SurfaceReconstruction::reconstruct(points, polygons)", multiresolution,
       isEmpty(vertices) && polygons.empty());

  MlsSurface<Point> surface;
  prepare(surface);
  note("MlsSurface::compute", surface, !surface.compute());
  outcomes.back().code = surface.status().code;
  return outcomes;
}

void expectAll(StatusCode code, const Cloud::ConstPtr& cloud, const pcl::IndicesPtr& indices,
               const pcl::PolygonMesh::ConstPtr& mesh) {
  for (const Outcome& outcome : runAll(cloud, indices, mesh)) {
    EXPECT_EQ(name(outcome.code), std::string(name(code))) << outcome.verb;
    EXPECT_TRUE(outcome.empty) << outcome.verb;
  }
}

TEST(BaseClassTraps, AMissingCloudIsReportedAndNotRead) {
  expectAll(StatusCode::NoInput, nullptr, nullptr, sphereMesh(40));
}

TEST(BaseClassTraps, AMissingMeshIsReportedAndNotRead) {
  Refinement refinement;
  refinement.setInputCloud(cloudOf<Point>(spherePoints(200)));
  pcl::PolygonMesh output = usedMesh();
  refinement.process(output);
  EXPECT_EQ(refinement.status().code, StatusCode::NoMesh);
  EXPECT_TRUE(isEmpty(output));
  refinement.setInputMesh(pcl::PolygonMesh::ConstPtr(new pcl::PolygonMesh));
  output = usedMesh();
  refinement.compute(output);
  EXPECT_EQ(refinement.status().code, StatusCode::NoMesh);
  EXPECT_TRUE(isEmpty(output));
}

TEST(BaseClassTraps, OutputsOfAnEmptyCloudAreWellFormed) {
  expectAll(StatusCode::EmptyInput, Cloud::ConstPtr(new Cloud), nullptr, sphereMesh(40));
}

TEST(BaseClassTraps, OutputsOfUselessPointsAreWellFormed) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Cloud::Ptr cloud = cloudOf<Point>({{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}});
  cloud->push_back(Point(nan, 0, 0));
  cloud->is_dense = false;
  const auto mesh = sphereMesh(40);
  expectAll(StatusCode::TooFewPoints, cloud, nullptr, mesh);
  expectAll(StatusCode::DegenerateInput, cloudOf<Point>({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}),
            nullptr, mesh);
}

TEST(BaseClassTraps, IndicesOfALargerCloudAreRefused) {
  const auto mesh = sphereMesh(40);
  const Cloud::ConstPtr large = cloudOf<Point>(spherePoints(300));
  const Cloud::ConstPtr small = cloudOf<Point>(spherePoints(100));
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 150; i < 300; ++i) indices->push_back(i);
  Multiresolution step;
  step.setInputCloud(large);
  step.setIndices(indices);
  pcl::PolygonMesh output;
  step.reconstruct(output);
  EXPECT_TRUE(step.status().ok()) << step.status().message;
  step.setInputCloud(small);
  step.reconstruct(output);
  EXPECT_EQ(step.status().code, StatusCode::InvalidIndices);
  EXPECT_TRUE(isEmpty(output));
  expectAll(StatusCode::InvalidIndices, small, indices, mesh);
  const pcl::IndicesPtr negative(new pcl::Indices{0, 1, 2, -1});
  expectAll(StatusCode::InvalidIndices, small, negative, mesh);
}

TEST(BaseClassTraps, ThePreviousCloudsImpliedIndicesAreForgotten) {
  Triangulation step;
  step.setInputCloud(cloudOf<Point>(spherePoints(300)));
  std::vector<pcl::Vertices> polygons;
  step.reconstruct(polygons);
  EXPECT_EQ(polygons.size(), 596u);
  step.setInputCloud(cloudOf<Point>(spherePoints(100)));
  step.reconstruct(polygons);
  EXPECT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(polygons.size(), 196u);
}

TEST(BaseClassTraps, PolygonsIndexTheWholeCloudWhenIndicesAreSet) {
  // Two spheres; the indices choose the second, in reverse order.
  auto positions = spherePoints(150);
  const auto second = spherePoints(200, {10, 0, 0});
  positions.insert(positions.end(), second.begin(), second.end());
  const auto cloud = cloudOf<Point>(positions);
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 349; i >= 150; --i) indices->push_back(i);
  Triangulation step;
  step.setInputCloud(cloud);
  step.setIndices(indices);
  pcl::PolygonMesh output;
  step.reconstruct(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(output.cloud.width, 350u);
  EXPECT_EQ(output.polygons.size(), 396u);
  for (const auto& triangle : trianglesOf(output.polygons)) {
    for (const auto corner : triangle) EXPECT_GE(corner, 150);
  }
  EXPECT_EQ(reportOf(output).border_edges, 0);
  EXPECT_EQ(reportOf(output).isolated_vertices, 150);
}

// A k-d tree that remembers what it was given. The result type of setInputCloud differs between PCL's
// versions.
class SpyTree : public pcl::search::KdTree<Point> {
 public:
  using Base = pcl::search::Search<Point>;
  using Result = decltype(std::declval<Base&>().setInputCloud(Cloud::ConstPtr(), pcl::IndicesConstPtr()));

  Result setInputCloud(const Cloud::ConstPtr& cloud, const pcl::IndicesConstPtr& indices) override {
    given.push_back(cloud);
    with_indices = with_indices || indices;
    return pcl::search::KdTree<Point>::setInputCloud(cloud, indices);
  }

  std::vector<Cloud::ConstPtr> given;
  bool with_indices = false;
};

template <typename StepT>
void expectCleanedTree(StepT& step, const char* what) {
  pcl::shared_ptr<SpyTree> spy(new SpyTree);
  step.setSearchMethod(spy);
  pcl::PolygonMesh output;
  step.compute(output);
  ASSERT_TRUE(step.status().ok()) << what << ": " << step.status().message;
  ASSERT_EQ(spy->given.size(), 1u) << what;
  EXPECT_FALSE(spy->with_indices) << what;
  EXPECT_EQ(spy->given[0]->size(), 300u) << what;
  for (const Point& point : *spy->given[0]) {
    EXPECT_LT(positionOf(point).cwiseAbs().maxCoeff(), 3)
        << what << ": not finite, or the origin was not taken off";
  }
}

TEST(BaseClassTraps, ATreeIsGivenTheCleanedShiftedPointsOnce) {
  // 300 distinct points far from the origin, with duplicates and points that are not finite between them.
  auto positions = spherePoints(300, {1000, -2000, 500});
  positions.push_back(positions[7]);
  positions.insert(positions.begin(), core::Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  positions.push_back(core::Vec3::Constant(std::numeric_limits<double>::infinity()));
  const auto cloud = cloudOf<Point>(positions);
  cloud->is_dense = false;
  Triangulation triangulation;
  triangulation.setInputCloud(cloud);
  expectCleanedTree(triangulation, "triangulation");
  Multiresolution multiresolution;
  multiresolution.setInputCloud(cloud);
  expectCleanedTree(multiresolution, "multiresolution");
  Refinement refinement;
  refinement.setInputCloud(cloud);
  const auto mesh = sphereMesh(60);
  Cloud vertices;
  pcl::fromPCLPointCloud2(mesh->cloud, vertices);
  for (Point& point : vertices) point.getVector3fMap() += Eigen::Vector3f(1000, -2000, 500);
  pcl::toPCLPointCloud2(vertices, mesh->cloud);
  refinement.setInputMesh(mesh);
  expectCleanedTree(refinement, "refinement");
}

TEST(BaseClassTraps, NoTreeIsMadeBehindTheUsersBack) {
  Triangulation triangulation;
  triangulation.setInputCloud(cloudOf<Point>(spherePoints(100)));
  pcl::PolygonMesh output;
  triangulation.reconstruct(output);
  EXPECT_EQ(triangulation.getSearchMethod(), nullptr);
  Multiresolution multiresolution;
  multiresolution.setInputCloud(cloudOf<Point>(spherePoints(100)));
  multiresolution.reconstruct(output);
  EXPECT_EQ(multiresolution.getSearchMethod(), nullptr);
}

TEST(BaseClassTraps, RefinementWorksThroughItsBase) {
  Refinement refinement;
  refinement.setInputCloud(cloudOf<Point>(spherePoints(1000)));
  refinement.setInputMesh(sphereMesh(40));
  pcl::PolygonMesh direct, through_base;
  refinement.process(direct);
  ASSERT_TRUE(refinement.status().ok()) << refinement.status().message;
  static_cast<pcl::MeshProcessing&>(refinement).process(through_base);
  EXPECT_TRUE(refinement.status().ok());
  EXPECT_TRUE(sameMesh(direct, through_base));
  // PCL's own check of the mesh prints and returns; ours reports.
  refinement.setInputMesh(pcl::PolygonMesh::ConstPtr(new pcl::PolygonMesh));
  static_cast<pcl::MeshProcessing&>(refinement).process(through_base);
  EXPECT_EQ(refinement.status().code, StatusCode::NoMesh);
  EXPECT_TRUE(isEmpty(through_base));
}

TEST(BaseClassTraps, ACloudWhoseSizesWereNotKeptUpIsTaken) {
  const auto cloud = cloudOf<Point>(spherePoints(100));
  cloud->width = 7;
  cloud->height = 3;
  Triangulation triangulation;
  triangulation.setInputCloud(cloud);
  pcl::PolygonMesh output;
  triangulation.reconstruct(output);
  ASSERT_TRUE(triangulation.status().ok()) << triangulation.status().message;
  EXPECT_EQ(output.cloud.width, 100u);
  EXPECT_EQ(output.cloud.height, 1u);
  EXPECT_EQ(output.cloud.data.size(), 100u * output.cloud.point_step);
}

TEST(BaseClassTraps, FarFromTheOriginFloatsKeepTheirTopology) {
  // At 1e5 a float resolves 1/128: the cloud is a sphere of radius 100 as a geodetic frame would hold it.
  auto positions = spherePoints(2000);
  for (core::Vec3& position : positions) position = 100 * position + core::Vec3(300000, -200000, 100000);
  Multiresolution multiresolution;
  multiresolution.setInputCloud(cloudOf<Point>(positions));
  pcl::PolygonMesh output;
  multiresolution.reconstruct(output);
  ASSERT_TRUE(multiresolution.status().ok()) << multiresolution.status().message;
  const MeshReport report = reportOf(output);
  EXPECT_TRUE(report.isSound());
  EXPECT_EQ(report.genus, 0);
  EXPECT_EQ(report.border_loops, 0);
  for (const core::Vec3& position : positionsOf(output)) {
    EXPECT_NEAR((position - core::Vec3(300000, -200000, 100000)).norm(), 100, 0.5);
  }
}

}  // namespace
}  // namespace mlsmesh::testing

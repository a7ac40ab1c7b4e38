// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"
#include "mlsmesh/advancing_front_triangulation.h"
#include "mlsmesh/mls_multiresolution.h"
#include "mlsmesh/mls_refinement.h"

#include <gtest/gtest.h>

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace mlsmesh::testing {
namespace {

using Point = pcl::PointXYZ;

template <typename PointT>
pcl::PolygonMesh::Ptr meshOf(const typename pcl::PointCloud<PointT>::ConstPtr& cloud) {
  AdvancingFrontTriangulation<PointT> step;
  step.setInputCloud(cloud);
  pcl::PolygonMesh::Ptr mesh(new pcl::PolygonMesh);
  step.reconstruct(*mesh);
  EXPECT_TRUE(step.status().ok()) << step.status().message;
  return mesh;
}

double farthestFromSphere(const pcl::PolygonMesh& mesh) {
  double worst = 0;
  const auto positions = positionsOf(mesh);
  for (const auto& triangle : trianglesOf(mesh.polygons)) {
    const core::Vec3 middle = (positions[triangle[0]] + positions[triangle[1]] + positions[triangle[2]]) / 3;
    worst = std::max(worst, std::abs(middle.norm() - 1));
  }
  return worst;
}

template <typename StepT>
void expectNestedLevels(const StepT& step, int levels) {
  ASSERT_EQ(step.getLevelCount(), levels);
  pcl::PolygonMesh coarse;
  ASSERT_TRUE(step.getLevel(0, coarse));
  for (int level = 1; level < levels; ++level) {
    pcl::PolygonMesh fine;
    ASSERT_TRUE(step.getLevel(level, fine));
    ASSERT_GE(fine.cloud.data.size(), coarse.cloud.data.size());
    EXPECT_TRUE(std::equal(coarse.cloud.data.begin(), coarse.cloud.data.end(), fine.cloud.data.begin()));
    EXPECT_TRUE(reportOf(fine).isSound());
    coarse = fine;
  }
  EXPECT_FALSE(step.getLevel(-1, coarse));
  EXPECT_TRUE(isEmpty(coarse));
  EXPECT_FALSE(step.getLevel(levels, coarse));
  EXPECT_TRUE(isEmpty(coarse));
}

TEST(MlsRefinement, LevelsApproachTheSphereAndNest) {
  const auto mesh = meshOf<Point>(cloudOf<Point>(spherePoints(80)));
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(8000)));
  step.setInputMesh(mesh);
  step.setLevels(3);
  pcl::PolygonMesh output;
  step.process(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  expectNestedLevels(step, 4);
  pcl::PolygonMesh level;
  double error = 1;
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(step.getLevel(i, level));
    EXPECT_EQ(reportOf(level).border_edges, 0);
    EXPECT_LT(farthestFromSphere(level), error) << i;
    error = farthestFromSphere(level);
  }
  EXPECT_TRUE(sameMesh(level, output)) << "process() gives the finest level";
  EXPECT_LT(error, 0.005);
  for (const core::Vec3& position : positionsOf(output)) EXPECT_NEAR(position.norm(), 1, 1e-3);
}

TEST(MlsRefinement, LevelZeroIsTheInputMesh) {
  // The unused vertices, one of them not finite, are kept where they are.
  const auto cloud = cloudOf<Point>(spherePoints(80));
  cloud->insert(cloud->begin() + 10, Point(std::numeric_limits<float>::quiet_NaN(), 1, 2));
  cloud->push_back((*cloud)[0]);
  cloud->is_dense = false;
  const auto mesh = meshOf<Point>(cloud);
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(2000)));
  step.setInputMesh(mesh);
  pcl::PolygonMesh output, zero;
  step.process(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  ASSERT_TRUE(step.getLevel(0, zero));
  EXPECT_TRUE(sameTriangles(zero, *mesh));
  pcl::PointCloud<Point> before, after;
  pcl::fromPCLPointCloud2(mesh->cloud, before);
  pcl::fromPCLPointCloud2(output.cloud, after);
  ASSERT_EQ(before.size(), 82u);
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(std::memcmp(&before[i].x, &after[i].x, 3 * sizeof(float)), 0) << i;
  }
}

TEST(MlsRefinement, ZeroStepsGiveTheInputMesh) {
  const auto mesh = meshOf<Point>(cloudOf<Point>(spherePoints(80)));
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(500)));
  step.setInputMesh(mesh);
  step.setLevels(0);
  pcl::PolygonMesh output;
  step.process(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(step.getLevelCount(), 1);
  EXPECT_TRUE(sameTriangles(output, *mesh));
}

TEST(MlsRefinement, NormalsFaceAsTheTrianglesDo) {
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(2000)));
  step.setInputMesh(meshOf<Point>(cloudOf<Point>(spherePoints(80))));
  pcl::PolygonMesh output;
  step.process(output);
  pcl::PointCloud<pcl::PointNormal> vertices;
  detail::fromBlob(output.cloud, vertices);
  for (const auto& vertex : vertices) {
    EXPECT_GT(vertex.getNormalVector3fMap().dot(vertex.getVector3fMap()), 0.98f);
  }
}

TEST(MlsRefinement, NewVerticesAverageColourAndTakeTheLabelOfTheNearerEnd) {
  const auto cloud = cloudOf<pcl::PointXYZRGBL>(spherePoints(80));
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].r = static_cast<std::uint8_t>(3 * i);
    (*cloud)[i].label = static_cast<std::uint32_t>(500 + i);
  }
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(2000)));
  step.setInputMesh(meshOf<pcl::PointXYZRGBL>(cloud));
  step.setLevels(1);
  pcl::PolygonMesh output;
  step.process(output);
  pcl::PointCloud<pcl::PointXYZRGBL> vertices;
  detail::fromBlob(output.cloud, vertices);
  ASSERT_GT(vertices.size(), 200u) << step.status().message;
  const auto& parents = step.refinedMesh().parents;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto [a, b] = parents[i];
    EXPECT_EQ(vertices[i].r, (vertices[a].r + vertices[b].r + 1) / 2);
    EXPECT_TRUE(vertices[i].label == vertices[a].label || vertices[i].label == vertices[b].label);
  }
}

TEST(MlsRefinement, DoubleCoordinatesKeepTheirDigits) {
  // A mesh in a national grid: floats there resolve half a metre, the mesh is two metres across.
  const core::Vec3 centre(691875.125, 5334567.25, 500.5);
  const auto coarse = meshOf<Point>(cloudOf<Point>(spherePoints(80)));
  std::vector<core::Vec3> world = positionsOf(*coarse);
  for (core::Vec3& position : world) position += centre;
  VertexData data;
  data.position = world;
  data.stored_as = core::StoredAs::Double;
  VertexSources sources;
  for (int i = 0; i < 80; ++i) sources.nearest.push_back(i);
  const pcl::PolygonMesh::Ptr mesh(new pcl::PolygonMesh(*coarse));
  makeVertexCloud(coarse->cloud, data, sources, mesh->cloud);
  auto positions = spherePoints(2000);
  for (core::Vec3& position : positions) position = 0.5 * position + centre;
  // The cloud itself is held in floats, as PCL's point types do: nothing but its size is left of the sphere.
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(positions));
  step.setInputMesh(mesh);
  pcl::PolygonMesh output, zero;
  step.process(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  ASSERT_TRUE(step.getLevel(0, zero));
  EXPECT_EQ(positionsOf(zero), world);
  core::StoredAs stored_as = core::StoredAs::Float;
  worldPositions(output.cloud, stored_as);
  EXPECT_EQ(stored_as, core::StoredAs::Double);
}

void expectInvalid(const std::function<void(pcl::PolygonMesh&)>& spoil, const std::string& culprit) {
  const auto mesh = meshOf<Point>(cloudOf<Point>(spherePoints(80)));
  spoil(*mesh);
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(500)));
  step.setInputMesh(mesh);
  pcl::PolygonMesh output = usedMesh();
  step.process(output);
  EXPECT_EQ(step.status().code, StatusCode::InvalidMesh) << culprit;
  EXPECT_NE(step.status().message.find(culprit), std::string::npos) << step.status().message;
  EXPECT_TRUE(isEmpty(output)) << culprit;
  EXPECT_EQ(step.getLevelCount(), 0) << culprit;
}

TEST(MlsRefinement, MeshesThatAreNotOrientedManifoldsAreRefused) {
  expectInvalid([](auto& mesh) { mesh.polygons[7].vertices.push_back(3); }, "4 corners");
  expectInvalid([](auto& mesh) { mesh.polygons[7].vertices[0] = 80; }, "vertex 80");
  expectInvalid([](auto& mesh) { mesh.polygons[7].vertices[0] = -1; }, "polygon 7");
  expectInvalid([](auto& mesh) { mesh.polygons[7].vertices[0] = mesh.polygons[7].vertices[1]; }, "manifold");
  expectInvalid([](auto& mesh) { std::swap(mesh.polygons[7].vertices[0], mesh.polygons[7].vertices[1]); },
                "manifold");
  expectInvalid([](auto& mesh) { mesh.polygons.push_back(mesh.polygons[7]); }, "manifold");
  expectInvalid([](auto& mesh) { mesh.cloud.fields[0].name = "u"; }, "'x'");
  expectInvalid(
      [](auto& mesh) {
        const float nan = std::numeric_limits<float>::quiet_NaN();
        std::memcpy(mesh.cloud.data.data(), &nan, sizeof(nan));
      },
      "vertex 0 is not finite");
}

TEST(MlsRefinement, PinchedVerticesAreRefused) {
  // Two fans that meet in vertex 0 alone: edges are fine, the vertex is not.
  pcl::PolygonMesh::Ptr mesh(new pcl::PolygonMesh);
  detail::toBlob(*cloudOf<Point>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}), mesh->cloud);
  mesh->polygons.resize(2);
  mesh->polygons[0].vertices = {0, 1, 2};
  mesh->polygons[1].vertices = {0, 3, 4};
  MlsRefinement<Point> step;
  step.setInputCloud(cloudOf<Point>(latticePoints(10)));
  step.setInputMesh(mesh);
  pcl::PolygonMesh output;
  step.process(output);
  EXPECT_EQ(step.status().code, StatusCode::InvalidMesh);
}

TEST(MlsMultiresolution, LevelsOfASphereNestAndAreClosed) {
  MlsMultiresolution<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(5000)));
  step.setLevels(3);
  pcl::PolygonMesh output;
  step.reconstruct(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  expectNestedLevels(step, 4);
  ASSERT_EQ(step.reports().size(), 4u);
  for (int level = 0; level < 4; ++level) {
    pcl::PolygonMesh mesh;
    ASSERT_TRUE(step.getLevel(level, mesh));
    EXPECT_EQ(mesh.header.frame_id, "scanner");
    const MeshReport& report = step.reports()[level];
    EXPECT_EQ(static_cast<std::size_t>(report.vertices), mesh.cloud.width);
    EXPECT_EQ(static_cast<std::size_t>(report.triangles), mesh.polygons.size());
    EXPECT_TRUE(report.isSound());
    EXPECT_EQ(report.isolated_vertices, 0);
    EXPECT_EQ(report.border_loops, 0);
    EXPECT_EQ(report.genus, 0);
    EXPECT_GT(volume(mesh), 0) << "a closed surface faces outward";
  }
  // Edges are left whole where the surface is nearer than 0.05 local spacings, here 0.05 * 0.05.
  EXPECT_NEAR(volume(output), 4 * kPi / 3, 4 * kPi * 0.0025);
  EXPECT_FALSE(step.stages().empty());
  EXPECT_EQ(step.progress().fraction(), 1.0);
}

TEST(MlsMultiresolution, AnOpenCylinderKeepsItsTwoBordersAtEveryLevel) {
  MlsMultiresolution<Point> step;
  step.setInputCloud(cloudOf<Point>(cylinderPoints(80, 40)));
  pcl::PolygonMesh output;
  step.reconstruct(output);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  for (const MeshReport& report : step.reports()) {
    EXPECT_TRUE(report.isSound());
    EXPECT_EQ(report.border_loops, 2);
    EXPECT_EQ(report.genus, 0);
  }
}

TEST(MlsMultiresolution, PatchesOverHolesAreColouredAsTheirSurroundings) {
  // Red above, blue below, and open at both poles.
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZRGB>);
  for (const core::Vec3& p : spherePoints(6000)) {
    if (std::abs(p.z()) > 0.9) continue;
    pcl::PointXYZRGB point;
    point.getVector3fMap() = p.cast<float>();
    point.r = p.z() > 0 ? 200 : 0;
    point.b = p.z() > 0 ? 0 : 200;
    cloud->push_back(point);
  }
  MlsMultiresolution<pcl::PointXYZRGB> step;
  step.parameters().watertight = true;
  step.setInputCloud(cloud);
  pcl::PointCloud<pcl::PointXYZRGB> points;
  std::vector<pcl::Vertices> polygons;
  step.reconstruct(points, polygons);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_EQ(step.reports().back().border_loops, 0);
  const auto& kinds = step.reconstruction().mesh.kind;
  int above = 0, below = 0;
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (kinds[v] != core::VertexKind::Patch) continue;
    ++(points[v].z > 0 ? above : below);
    EXPECT_EQ(points[v].r, points[v].z > 0 ? 200 : 0);
    EXPECT_EQ(points[v].b, points[v].z > 0 ? 0 : 200);
  }
  EXPECT_GT(above, 3);
  EXPECT_GT(below, 3);
  pcl::PolygonMesh mesh;
  step.reconstruct(mesh);
  pcl::PointCloud<pcl::PointNormal> attributes;
  pcl::fromPCLPointCloud2(mesh.cloud, attributes);
  for (const pcl::PointNormal& p : attributes) {
    EXPECT_NEAR(p.getNormalVector3fMap().norm(), 1, 1e-4);
    EXPECT_TRUE(p.curvature >= 0 && p.curvature < 0.34f) << p.curvature;
  }
}

TEST(MlsMultiresolution, EveryVerbGivesTheSameMesh) {
  MlsMultiresolution<pcl::PointNormal> step;
  step.setInputCloud(cloudOf<pcl::PointNormal>(spherePoints(1000)));
  pcl::PolygonMesh reconstructed, computed, finest;
  step.reconstruct(reconstructed);
  step.compute(computed);
  ASSERT_TRUE(step.getLevel(step.getLevelCount() - 1, finest));
  pcl::PointCloud<pcl::PointNormal> points, expected;
  std::vector<pcl::Vertices> polygons;
  step.reconstruct(points, polygons);
  EXPECT_TRUE(sameMesh(reconstructed, computed));
  EXPECT_TRUE(sameMesh(reconstructed, finest));
  EXPECT_EQ(trianglesOf(polygons), trianglesOf(finest.polygons));
  pcl::fromPCLPointCloud2(finest.cloud, expected);
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(positionOf(points[i]), positionOf(expected[i]));
    EXPECT_GT(points[i].getNormalVector3fMap().dot(points[i].getVector3fMap()), 0.9f) << "outward";
  }
}

TEST(MlsMultiresolution, ThreadsAndTheOrderOfTheInputDoNotMatter) {
  const auto cloud = cloudOf<pcl::PointXYZRGB>(spherePoints(3000));
  for (std::size_t i = 0; i < cloud->size(); ++i)
    (*cloud)[i].rgba = static_cast<std::uint32_t>(i * 2654435761u);
  pcl::PointCloud<pcl::PointXYZRGB>::Ptr reversed(new pcl::PointCloud<pcl::PointXYZRGB>(*cloud));
  std::reverse(reversed->begin(), reversed->end());
  MlsMultiresolution<pcl::PointXYZRGB> step;
  step.setInputCloud(cloud);
  step.setNumberOfThreads(1);
  pcl::PolygonMesh one, many, other_order;
  step.reconstruct(one);
  ASSERT_TRUE(step.status().ok()) << step.status().message;
  step.setNumberOfThreads(4);
  step.reconstruct(many);
  step.setInputCloud(reversed);
  step.reconstruct(other_order);
  EXPECT_TRUE(sameMesh(one, many));
  EXPECT_TRUE(sameMesh(one, other_order));
}

TEST(MlsMultiresolution, WithoutReductionTheVerticesAreInputPoints) {
  const auto cloud = cloudOf<pcl::PointXYZL>(spherePoints(700, {30, 20, 10}));
  for (std::size_t i = 0; i < cloud->size(); ++i) (*cloud)[i].label = static_cast<std::uint32_t>(i);
  MlsMultiresolution<pcl::PointXYZL> step;
  step.setInputCloud(cloud);
  step.parameters().reduce = false;
  step.setLevels(0);
  pcl::PointCloud<pcl::PointXYZL> points;
  std::vector<pcl::Vertices> polygons;
  step.reconstruct(points, polygons);
  ASSERT_EQ(points.size(), 700u) << step.status().message;
  EXPECT_EQ(polygons.size(), 1396u);
  for (const auto& point : points) EXPECT_EQ(positionOf(point), positionOf((*cloud)[point.label]));
}

TEST(MlsMultiresolution, ChangingTheCloudAfterwardsDoesNotTouchTheLevels) {
  const auto cloud = cloudOf<Point>(spherePoints(600));
  MlsMultiresolution<Point> step;
  step.setInputCloud(cloud);
  pcl::PolygonMesh before, after;
  step.reconstruct(before);
  cloud->clear();
  ASSERT_TRUE(step.getLevel(step.getLevelCount() - 1, after));
  EXPECT_TRUE(sameMesh(before, after));
}

TEST(MlsMultiresolution, AFailedRunLeavesNoOldLevels) {
  MlsMultiresolution<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(600)));
  pcl::PolygonMesh output;
  step.reconstruct(output);
  EXPECT_EQ(step.getLevelCount(), 3);
  step.parameters().projection.neighbors = 1;
  step.reconstruct(output);
  EXPECT_EQ(step.status().code, StatusCode::InvalidParameter);
  EXPECT_NE(step.status().message.find("neighbors"), std::string::npos) << step.status().message;
  EXPECT_EQ(step.getLevelCount(), 0);
  EXPECT_FALSE(step.getLevel(0, output));
  EXPECT_TRUE(isEmpty(output));
}

TEST(MlsMultiresolution, ACancelledRunIsEmptyAndMayBeRepeated) {
  MlsMultiresolution<Point> step;
  step.setInputCloud(cloudOf<Point>(spherePoints(600)));
  Progress progress;
  step.setProgress(progress);
  progress.cancel();
  pcl::PolygonMesh output = usedMesh();
  step.reconstruct(output);
  EXPECT_EQ(step.status().code, StatusCode::Cancelled);
  EXPECT_TRUE(isEmpty(output));
  progress.reset();
  step.reconstruct(output);
  EXPECT_TRUE(step.status().ok()) << step.status().message;
  EXPECT_FALSE(isEmpty(output));
}

TEST(MlsMultiresolution, UnusablePointsAreSkipped) {
  auto positions = spherePoints(600);
  const auto clean = cloudOf<Point>(positions);
  positions.push_back(core::Vec3::Constant(std::numeric_limits<double>::quiet_NaN()));
  positions.insert(positions.begin(), positions[99]);
  const auto dirty = cloudOf<Point>(positions);
  dirty->is_dense = false;
  MlsMultiresolution<Point> step;
  pcl::PolygonMesh expected, output;
  step.setInputCloud(clean);
  step.reconstruct(expected);
  step.setInputCloud(dirty);
  step.reconstruct(output);
  EXPECT_TRUE(sameMesh(expected, output));
  EXPECT_EQ(step.reconstruction().points.non_finite, 1);
  EXPECT_EQ(step.reconstruction().points.duplicates, 1);
}

TEST(ReadmeExample, WritesBothMeshesOfACloudFile) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(::testing::TempDir()) / ("mlsmesh_readme_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  ASSERT_EQ(pcl::io::savePCDFileBinary((folder / "cloud.pcd").string(), *cloudOf<Point>(spherePoints(2000))),
            0);
  const std::string command = "cd '" + folder.string() + "' && '" + MLSMESH_README_EXAMPLE + "' cloud.pcd";
  EXPECT_EQ(std::system(command.c_str()), 0);
  for (const char* file : {"ours.ply", "gp3.ply"}) EXPECT_GT(fs::file_size(folder / file), 10000u);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace mlsmesh::testing

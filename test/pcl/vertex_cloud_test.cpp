// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/vertex_cloud.h"

#include "clouds.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/detail/cloud.h"

#include <gtest/gtest.h>

#include <pcl/point_types.h>

#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace mlsmesh::testing {
namespace {

using core::Index;
using core::Vec3;
using Field = pcl::PCLPointField;

// A blob under construction: one row of `points` points, fields appended one after the other.
class Blob {
 public:
  explicit Blob(std::size_t points) : points_(points) {
    cloud.width = static_cast<pcl::uindex_t>(points);
    cloud.height = 1;
  }

  template <typename T>
  Blob& add(const std::string& name, Field::PointFieldTypes type, const std::vector<T>& values) {
    Field field;
    field.name = name;
    field.datatype = static_cast<std::uint8_t>(type);
    field.count = static_cast<pcl::uindex_t>(values.size() / points_);
    field.offset = cloud.point_step;
    const std::size_t size = sizeof(T) * field.count;
    std::vector<std::uint8_t> data;
    for (std::size_t i = 0; i < points_; ++i) {
      const auto* old = cloud.data.data() + i * cloud.point_step;
      data.insert(data.end(), old, old + cloud.point_step);
      const auto* fresh = reinterpret_cast<const std::uint8_t*>(values.data()) + i * size;
      data.insert(data.end(), fresh, fresh + size);
    }
    cloud.fields.push_back(field);
    cloud.point_step += static_cast<pcl::uindex_t>(size);
    cloud.row_step = cloud.point_step * cloud.width;
    cloud.data = std::move(data);
    return *this;
  }

  pcl::PCLPointCloud2 cloud;

 private:
  std::size_t points_;
};

Blob threePoints() {
  Blob blob(3);
  blob.add<float>("x", Field::FLOAT32, {0, 1, 2});
  blob.add<float>("y", Field::FLOAT32, {0, 0, 0});
  blob.add<float>("z", Field::FLOAT32, {5, 6, 7});
  return blob;
}

const Field* find(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  for (const Field& field : cloud.fields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

template <typename T>
std::vector<T> values(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  const Field* field = find(cloud, name);
  EXPECT_NE(field, nullptr) << name;
  if (!field) return {};
  std::vector<T> result(static_cast<std::size_t>(cloud.width) * field->count);
  for (std::size_t i = 0; i < cloud.width; ++i) {
    std::memcpy(&result[i * field->count], &cloud.data[i * cloud.point_step + field->offset],
                sizeof(T) * field->count);
  }
  return result;
}

core::IndexLists lists(const std::vector<std::vector<Index>>& of) {
  core::IndexLists result;
  for (const auto& list : of) {
    result.items.insert(result.items.end(), list.begin(), list.end());
    result.begin.push_back(static_cast<Index>(result.items.size()));
  }
  return result;
}

// One vertex for all points, one for the last point, and one between these two.
VertexData threeVertices() {
  VertexData data;
  data.position = {{0.5, 0.25, 5.5}, {2, 0, 7}, {1.25, 0.125, 6.25}};
  return data;
}

VertexSources threeSources() {
  return {lists({{0, 1, 2}, {2}}), {{0, 0}, {1, 1}, {0, 1}}, {1, 2, 1}};
}

StatusCode failureOf(const std::function<void()>& work) {
  const Status status = core::guarded(work);
  EXPECT_FALSE(status.message.empty());
  return status.code;
}

TEST(WorldPositions, EveryNumericTypeIsRead) {
  Blob blob(2);
  blob.add<float>("intensity", Field::FLOAT32, {9, 9});
  blob.add<std::int16_t>("x", Field::INT16, {-3, 300});
  blob.add<float>("y", Field::FLOAT32, {0.5f, -0.25f});
  blob.add<std::uint8_t>("z", Field::UINT8, {7, 255});
  core::StoredAs stored_as = core::StoredAs::Double;
  const auto positions = worldPositions(blob.cloud, stored_as);
  EXPECT_EQ(stored_as, core::StoredAs::Float);
  EXPECT_EQ(positions, (std::vector<Vec3>{{-3, 0.5, 7}, {300, -0.25, 255}}));
}

TEST(WorldPositions, DoublesKeepEveryDigit) {
  const std::vector<double> east{691875.123456789, 691876.987654321}, north{5334567.000000123, 5334568.5};
  Blob blob(2);
  blob.add("x", Field::FLOAT64, east)
      .add("y", Field::FLOAT64, north)
      .add<double>("z", Field::FLOAT64, {0.1, 0.2});
  core::StoredAs stored_as = core::StoredAs::Float;
  const auto positions = worldPositions(blob.cloud, stored_as);
  EXPECT_EQ(stored_as, core::StoredAs::Double);
  EXPECT_EQ(positions, (std::vector<Vec3>{{east[0], north[0], 0.1}, {east[1], north[1], 0.2}}));
}

TEST(WorldPositions, RowsMayBePadded) {
  Blob blob = threePoints();
  pcl::PCLPointCloud2 padded = blob.cloud;
  padded.width = 1;
  padded.height = 3;
  padded.row_step = padded.point_step + 5;
  padded.data.clear();
  for (int row = 0; row < 3; ++row) {
    const auto* from = blob.cloud.data.data() + row * blob.cloud.point_step;
    padded.data.insert(padded.data.end(), from, from + blob.cloud.point_step);
    if (row < 2) padded.data.insert(padded.data.end(), 5, 0xAA);
  }
  core::StoredAs stored_as;
  EXPECT_EQ(worldPositions(padded, stored_as), (std::vector<Vec3>{{0, 0, 5}, {1, 0, 6}, {2, 0, 7}}));
}

TEST(WorldPositions, WhatIsMissingIsNamed) {
  Blob blob(1);
  blob.add<float>("x", Field::FLOAT32, {1}).add<float>("z", Field::FLOAT32, {1});
  core::StoredAs stored_as;
  const Status status = core::guarded([&] { worldPositions(blob.cloud, stored_as); });
  EXPECT_EQ(status.code, StatusCode::EmptyInput);
  EXPECT_NE(status.message.find("'y'"), std::string::npos) << status.message;
}

TEST(WorldPositions, BrokenBlobsAreRefused) {
  core::StoredAs stored_as;
  pcl::PCLPointCloud2 cut = threePoints().cloud;
  cut.data.pop_back();
  EXPECT_EQ(failureOf([&] { worldPositions(cut, stored_as); }), StatusCode::EmptyInput);
  pcl::PCLPointCloud2 outside = threePoints().cloud;
  outside.fields[1].offset = 10;
  EXPECT_EQ(failureOf([&] { worldPositions(outside, stored_as); }), StatusCode::EmptyInput);
  pcl::PCLPointCloud2 foreign = threePoints().cloud;
  foreign.is_bigendian = !foreign.is_bigendian;
  EXPECT_EQ(failureOf([&] { worldPositions(foreign, stored_as); }), StatusCode::EmptyInput);
}

TEST(VertexCloud, PackedColourIsAveragedChannelByChannel) {
  // Blue, green, red, alpha; the mean of 0, 1, 1 rounds up, that of 0, 0, 1 down.
  Blob blob = threePoints();
  const auto pack = [](int b, int g, int r, int a) {
    return static_cast<std::uint32_t>(b) | static_cast<std::uint32_t>(g) << 8 |
           static_cast<std::uint32_t>(r) << 16 | static_cast<std::uint32_t>(a) << 24;
  };
  blob.add<std::uint32_t>("rgba", Field::UINT32,
                          {pack(0, 0, 255, 255), pack(1, 0, 255, 255), pack(1, 1, 100, 0)});
  pcl::PCLPointCloud2 output;
  makeVertexCloud(blob.cloud, threeVertices(), threeSources(), output);
  const auto colours = values<std::uint32_t>(output, "rgba");
  EXPECT_EQ(colours[0], pack(1, 0, 203, 170));
  EXPECT_EQ(colours[1], pack(1, 1, 100, 0));
  EXPECT_EQ(colours[2], pack(1, 1, 152, 85)) << "the rounded mean of the first two vertices";
}

TEST(VertexCloud, PackedColourStoredAsFloatIsTheSame) {
  // As PointXYZRGB stores it: the bits of some colours are not finite floats.
  Blob blob = threePoints();
  blob.add<std::uint32_t>("rgb", Field::UINT32, {0xFFFFFFFFu, 0xFF000000u, 0xFF7F7F7Fu});
  pcl::PCLPointCloud2 output;
  makeVertexCloud(blob.cloud, threeVertices(), threeSources(), output);
  const auto expected = values<std::uint32_t>(output, "rgb");
  blob.cloud.fields.back().datatype = Field::FLOAT32;
  makeVertexCloud(blob.cloud, threeVertices(), threeSources(), output);
  EXPECT_EQ(values<std::uint32_t>(output, "rgb"), expected);
  EXPECT_EQ(expected[0], 0xFF7F7F7Fu);
}

TEST(VertexCloud, SeparateColourBytesAndIntensityAreAveraged) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Blob blob = threePoints();
  blob.add<std::uint8_t>("r", Field::UINT8, {10, 20, 40});
  blob.add<float>("intensity", Field::FLOAT32, {1, nan, 4});
  pcl::PCLPointCloud2 output;
  makeVertexCloud(blob.cloud, threeVertices(), threeSources(), output);
  EXPECT_EQ(values<std::uint8_t>(output, "r"), (std::vector<std::uint8_t>{23, 40, 32}));
  EXPECT_EQ(values<float>(output, "intensity"), (std::vector<float>{2.5f, 4, 3.25f}));
}

TEST(VertexCloud, AveragesDoNotDependOnTheOrderOfMembers) {
  Blob blob = threePoints();
  blob.add<float>("intensity", Field::FLOAT32, {1e30f, 1.0f, -1e30f});
  VertexSources sources = threeSources();
  pcl::PCLPointCloud2 first, second;
  makeVertexCloud(blob.cloud, threeVertices(), sources, first);
  sources.members = lists({{2, 0, 1}, {2}});
  makeVertexCloud(blob.cloud, threeVertices(), sources, second);
  EXPECT_EQ(first.data, second.data);
}

TEST(VertexCloud, OtherFieldsComeFromTheNearestPoint) {
  Blob blob = threePoints();
  blob.add<std::uint16_t>("label", Field::UINT16, {100, 200, 300});
  blob.add<double>("stamp", Field::FLOAT64, {0.125, 0.25, 0.5});
  blob.add<float>("descriptor", Field::FLOAT32, {1, 2, 3, 4, 5, 6});
  blob.add<std::uint8_t>("_", Field::UINT8, {1, 1, 1});
  pcl::PCLPointCloud2 output;
  makeVertexCloud(blob.cloud, threeVertices(), threeSources(), output);
  EXPECT_EQ(values<std::uint16_t>(output, "label"), (std::vector<std::uint16_t>{200, 300, 200}));
  EXPECT_EQ(values<double>(output, "stamp"), (std::vector<double>{0.25, 0.5, 0.25}));
  EXPECT_EQ(values<float>(output, "descriptor"), (std::vector<float>{3, 4, 5, 6, 3, 4}));
  EXPECT_EQ(find(output, "_"), nullptr);
}

TEST(VertexCloud, ComputedFieldsAreReplacedOrAppended) {
  Blob blob = threePoints();
  blob.add<float>("curvature", Field::FLOAT32, {9, 9, 9});
  VertexData data = threeVertices();
  data.normal = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  data.curvature = {0.125, 0.25, 0.0625};
  data.cluster_size = {3, 1, 0};
  blob.cloud.header.frame_id = "frame";
  pcl::PCLPointCloud2 output;
  makeVertexCloud(blob.cloud, data, threeSources(), output);
  EXPECT_EQ(output.header.frame_id, "frame");
  EXPECT_EQ(output.width, 3u);
  EXPECT_EQ(output.height, 1u);
  EXPECT_EQ(output.data.size(), 3u * output.point_step);
  EXPECT_EQ(output.fields.size(), 8u);
  EXPECT_EQ(values<float>(output, "x"), (std::vector<float>{0.5f, 2, 1.25f}));
  EXPECT_EQ(values<float>(output, "curvature"), (std::vector<float>{0.125f, 0.25f, 0.0625f}));
  EXPECT_EQ(values<float>(output, "normal_z"), (std::vector<float>{0, 0, -1}));
  EXPECT_EQ(values<std::uint32_t>(output, "cluster_size"), (std::vector<std::uint32_t>{3, 1, 0}));
}

TEST(VertexCloud, FieldsThatAreNotComputedAreCarried) {
  Blob blob = threePoints();
  blob.add<float>("normal_x", Field::FLOAT32, {0.5f, 0.25f, 0.125f});
  pcl::PCLPointCloud2 output;
  makeVertexCloud(blob.cloud, threeVertices(), threeSources(), output);
  EXPECT_EQ(values<float>(output, "normal_x"), (std::vector<float>{0.25f, 0.125f, 0.25f}));
  EXPECT_EQ(find(output, "normal_y"), nullptr);
  EXPECT_EQ(find(output, "curvature"), nullptr);
}

TEST(VertexCloud, DoubleCoordinatesAreWrittenBackWhole) {
  Blob blob(1);
  blob.add<double>("x", Field::FLOAT64, {1})
      .add<double>("y", Field::FLOAT64, {2})
      .add<double>("z", Field::FLOAT64, {3});
  blob.add<std::uint8_t>("class", Field::UINT8, {6});
  VertexData data;
  data.stored_as = core::StoredAs::Double;
  data.position = {{691875.123456789, 5334567.000000123, 0.1}};
  pcl::PCLPointCloud2 output;
  makeVertexCloud(blob.cloud, data, {{}, {}, {0}}, output);
  core::StoredAs stored_as;
  EXPECT_EQ(worldPositions(output, stored_as), data.position);
  EXPECT_EQ(stored_as, core::StoredAs::Double);
  EXPECT_EQ(values<std::uint8_t>(output, "class"), (std::vector<std::uint8_t>{6}));
  for (const Field& field : output.fields) {
    EXPECT_EQ(field.offset % (field.datatype == Field::FLOAT64 ? 8 : 1), 0u) << field.name;
  }
  EXPECT_EQ(output.point_step % 8, 0u);
}

TEST(VertexCloud, NoVerticesGiveAWellFormedEmptyCloud) {
  pcl::PCLPointCloud2 output;
  makeVertexCloud(threePoints().cloud, {}, {}, output);
  EXPECT_EQ(output.width, 0u);
  EXPECT_EQ(output.height, 0u);
  EXPECT_TRUE(output.data.empty());
  EXPECT_EQ(output.fields.size(), 3u);
}

TEST(VertexCloud, SourcesOutsideTheInputAreRefused) {
  VertexSources sources = threeSources();
  sources.nearest[2] = 3;
  pcl::PCLPointCloud2 output;
  const auto write = [&] { makeVertexCloud(threePoints().cloud, threeVertices(), sources, output); };
  EXPECT_EQ(failureOf(write), StatusCode::Internal);
}

TEST(CloudConversion, PointTypesSurviveTheWayThroughABlob) {
  pcl::PointCloud<pcl::PointXYZRGBNormal> cloud;
  for (int i = 0; i < 5; ++i) {
    pcl::PointXYZRGBNormal point;
    point.x = static_cast<float>(i);
    point.normal_y = 0.5f;
    point.rgba = 0x80402010u + static_cast<unsigned>(i);
    cloud.push_back(point);
  }
  pcl::PCLPointCloud2 blob;
  detail::toBlob(cloud, blob);
  pcl::PointCloud<pcl::PointXYZRGBA> colours;
  detail::fromBlob(blob, colours);
  ASSERT_EQ(colours.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(colours[i].x, static_cast<float>(i));
    EXPECT_EQ(colours[i].rgba, 0x80402010u + static_cast<unsigned>(i)) << "rgb and rgba are one colour";
  }
  pcl::PointCloud<pcl::PointNormal> normals;
  detail::fromBlob(blob, normals);
  EXPECT_EQ(normals[3].normal_y, 0.5f);
  EXPECT_EQ(normals[3].curvature, 0.0f);
}

}  // namespace
}  // namespace mlsmesh::testing

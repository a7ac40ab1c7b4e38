// SPDX-License-Identifier: BSD-3-Clause
#include "common/cloud_columns.h"
#include "common/cloud_io.h"
#include "program.h"
#include "shapes/shape.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

Outcome runSample(const std::vector<std::string>& arguments) {
  const TemporaryFolder prints;
  return Program(MLSMESH_SAMPLE, arguments, prints.path()).wait();
}

std::vector<core::Vec3> readPoints(const std::string& file) {
  pcl::PCLPointCloud2 cloud;
  apps::readCloud(file, cloud);
  const std::vector<apps::FieldSlot> slots = apps::fieldSlots(cloud);
  std::vector<core::Vec3> points;
  for (std::size_t i = 0; i < apps::pointCount(cloud); ++i) {
    points.emplace_back(apps::slotValue(cloud, *apps::findSlot(slots, "x"), i),
                        apps::slotValue(cloud, *apps::findSlot(slots, "y"), i),
                        apps::slotValue(cloud, *apps::findSlot(slots, "z"), i));
  }
  return points;
}

class SampleFormat : public testing::TestWithParam<const char*> {};

TEST_P(SampleFormat, HoldsPointsOfTheSurface) {
  const TemporaryFolder folder;
  const std::string file = folder.file(std::string("cloud.") + GetParam());
  const Outcome outcome = runSample({"figure", file, "--count=400", "-seed", "5"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto shape = shapes::makeShape("figure");
  const std::vector<core::Vec3> points = readPoints(file);
  ASSERT_EQ(points.size(), 400U);
  for (const core::Vec3& point : points) EXPECT_LT(shape->distance(point), 2e-7) << "float32 rounding";
  EXPECT_EQ(folder.names().size(), 1U) << "no temporary file is left";
}

TEST_P(SampleFormat, IsTheSameFileForTheSameSeed) {
  const TemporaryFolder folder;
  const std::string a = folder.file(std::string("a.") + GetParam());
  const std::string b = folder.file(std::string("b.") + GetParam());
  const std::string c = folder.file(std::string("c.") + GetParam());
  const std::vector<std::string> options{"--count",    "200", "--noise", "0.001",
                                         "--outliers", "0.1", "--quiet"};
  const auto run = [&](const std::string& file, const char* seed) {
    std::vector<std::string> arguments{"moebius", file, "--seed", seed};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runSample(arguments).exit_code;
  };
  ASSERT_EQ(run(a, "9"), 0);
  ASSERT_EQ(run(b, "9"), 0);
  ASSERT_EQ(run(c, "10"), 0);
  EXPECT_EQ(readFile(a), readFile(b));
  EXPECT_NE(readFile(a), readFile(c));
}

INSTANTIATE_TEST_SUITE_P(Formats, SampleFormat, testing::Values("pcd", "ply", "xyz"));

TEST_P(SampleFormat, FullDiskLeavesTheOldFileAlone) {
  const TemporaryFolder folder, prints;
  const std::string output = folder.write(std::string("a.") + GetParam(), "old");
  const auto limit_file_size = [] {
    const rlimit limit = {5000, 5000};
    return setrlimit(RLIMIT_FSIZE, &limit) == 0;
  };
  const Outcome outcome =
      Program(MLSMESH_SAMPLE, {"sphere", output, "--count", "2000"}, prints.path(), limit_file_size).wait();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("disk full"), std::string::npos) << outcome.err;
  EXPECT_EQ(readFile(output), "old");
  EXPECT_EQ(folder.names().size(), 1U);
}

TEST(Sample, ColoursTheFigureUnlessToldNot) {
  const TemporaryFolder folder;
  const auto hasColor = [&](const std::vector<std::string>& arguments) {
    EXPECT_EQ(runSample(arguments).exit_code, 0);
    pcl::PCLPointCloud2 cloud;
    apps::readCloud(arguments[1], cloud);
    return apps::findField(cloud, "rgb") != nullptr;
  };
  EXPECT_TRUE(hasColor({"figure", folder.file("a.pcd"), "--count", "50"}));
  EXPECT_FALSE(hasColor({"figure", folder.file("b.pcd"), "--count", "50", "--colors", "no"}));
  EXPECT_FALSE(hasColor({"sphere", folder.file("c.pcd"), "--count", "50"}));
  EXPECT_TRUE(hasColor({"sphere", folder.file("d.pcd"), "--count", "50", "--colors", "yes"}));
}

struct Misuse {
  std::vector<std::string> arguments;  ///< OUT stands for a file in an empty folder
  int exit_code;
  std::string culprit;
};

void PrintTo(const Misuse& misuse, std::ostream* out) {
  for (const std::string& argument : misuse.arguments) *out << argument << ' ';
}

class SampleMisuse : public testing::TestWithParam<Misuse> {};

TEST_P(SampleMisuse, IsOneLineThatNamesTheCulprit) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = GetParam().arguments;
  std::replace(arguments.begin(), arguments.end(), std::string("OUT"), folder.file("out.pcd"));
  std::replace(arguments.begin(), arguments.end(), std::string("ABSENT"), folder.file("absent/out.pcd"));
  const Outcome outcome = runSample(arguments);
  EXPECT_EQ(outcome.exit_code, GetParam().exit_code);
  EXPECT_EQ(outcome.err.rfind("mlsmesh_sample: ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(GetParam().culprit), std::string::npos) << outcome.err;
  EXPECT_TRUE(folder.names().empty());
}

INSTANTIATE_TEST_SUITE_P(Cases, SampleMisuse,
                         testing::Values(Misuse{{}, 2, "SHAPE"}, Misuse{{"figure"}, 2, "OUTPUT"},
                                         Misuse{{"teapot", "OUT"}, 2, "teapot"},
                                         Misuse{{"figure", "OUT", "more"}, 2, "arguments"},
                                         Misuse{{"figure", "out.stl"}, 2, "out.stl"},
                                         Misuse{{"figure", "ABSENT"}, 1, "absent"},
                                         Misuse{{"figure", "OUT", "--cuont", "5"}, 2, "--count"},
                                         Misuse{{"figure", "OUT", "--count", "0"}, 2, "--count"},
                                         Misuse{{"figure", "OUT", "--count", "2.5"}, 2, "--count"},
                                         Misuse{{"figure", "OUT", "--noise=-1"}, 2, "--noise"},
                                         Misuse{{"figure", "OUT", "--noise", "nan"}, 2, "--noise"},
                                         Misuse{{"figure", "OUT", "--outliers", "1e9"}, 2, "--outliers"},
                                         Misuse{{"figure", "OUT", "--density", "w,2"}, 2, "--density"},
                                         Misuse{{"figure", "OUT", "--density", "y,0.5"}, 2, "--density"},
                                         Misuse{{"figure", "OUT", "--views", "-1"}, 2, "--views"},
                                         Misuse{{"figure", "OUT", "--seed", "x"}, 2, "--seed"},
                                         Misuse{{"figure", "OUT", "--colors", "blue"}, 2, "--colors"}));

TEST(Sample, HelpNamesEveryShape) {
  const Outcome outcome = runSample({"--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const std::string& name : shapes::shapeNames()) EXPECT_NE(outcome.out.find(name), std::string::npos);
}

}  // namespace
}  // namespace mlsmesh::test

// SPDX-License-Identifier: BSD-3-Clause
// A sphere of a metre in map coordinates gives the mesh that it gives at the origin, from and to every format
// that can hold it.
#include "common/mesh_reader.h"
#include "reconstruct_fixture.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <sstream>

namespace mlsmesh::test {
namespace {

using Json = nlohmann::json;

constexpr int kCount = 3000;
constexpr std::array<double, 3> kFar = {500000, 5400000, 300};

std::array<double, 3> placeOf(const SpherePoint& point, const std::array<double, 3>& center) {
  return {center[0] + point.position[0], center[1] + point.position[1], center[2] + point.position[2]};
}

/// "x y z" lines, each after `start`.
std::string lines(const std::string& start, const std::array<double, 3>& center) {
  std::ostringstream text;
  text << std::setprecision(17);
  for (const SpherePoint& point : spherePoints(kCount)) {
    const std::array<double, 3> p = placeOf(point, center);
    text << start << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
  }
  return text.str();
}

std::string pcdHead(const std::string& storage) {
  const std::string count = std::to_string(kCount);
  return "FIELDS x y z\nSIZE 8 8 8\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + count + "\nHEIGHT 1\nPOINTS " + count +
         "\nDATA " + storage + "\n";
}

std::string binaryPcd(const std::array<double, 3>& center) {
  std::string text = pcdHead("binary");
  for (const SpherePoint& point : spherePoints(kCount)) {
    const std::array<double, 3> p = placeOf(point, center);
    char bytes[sizeof p];
    std::memcpy(bytes, p.data(), sizeof p);
    text.append(bytes, sizeof bytes);
  }
  return text;
}

std::string inputOf(const std::string& name, const std::array<double, 3>& center) {
  if (name == "binary.pcd") return binaryPcd(center);
  if (name == "text.pcd") return pcdHead("ascii") + lines("", center);
  if (name == "text.ply") return sphereDoublePly(kCount, 1, center);
  if (name == "text.xyz") return lines("", center);
  if (name == "text.obj") return lines("v ", center);
  return "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS " + std::to_string(kCount) +
         " double\n" + lines("", center);
}

class FarClouds : public ReconstructTest, public testing::WithParamInterface<const char*> {
 protected:
  /// The topology of what mlsmesh_reconstruct makes of an input.
  Json topologyOf(const std::string& input, const std::string& output) const {
    runWell({input, output, "--json", folder_.file("r.json")});
    Json level = Json::parse(readFile(folder_.file("r.json"))).at("levels").back();
    return {level.at("vertices"), level.at("triangles")};
  }
};

TEST_P(FarClouds, GiveTheMeshOfTheOrigin) {
  const std::string name = GetParam();
  const std::string near = folder_.write("near_" + name, inputOf(name, {0, 0, 0}));
  const std::string far = folder_.write("far_" + name, inputOf(name, kFar));
  const Json expected = topologyOf(near, folder_.file("near.ply"));
  double near_error = 0;
  for (const core::Vec3& vertex : apps::readTriangles(folder_.file("near.ply")).vertices)
    near_error = std::max(near_error, std::abs(vertex.norm() - 1));
  for (const char* output : {"far.ply", "far.obj", "far.vtk", "far.vtp"}) {
    SCOPED_TRACE(output);
    EXPECT_EQ(topologyOf(far, folder_.file(output)), expected);
    for (const core::Vec3& vertex : apps::readTriangles(folder_.file(output)).vertices)
      EXPECT_NEAR((vertex - core::Vec3(kFar[0], kFar[1], kFar[2])).norm(), 1, near_error + 1e-6);
  }
  EXPECT_NE(run({far, folder_.file("far.stl")}).err.find("rounds the double coordinates"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Inputs, FarClouds,
                         testing::Values("binary.pcd", "text.pcd", "text.ply", "text.xyz", "text.obj",
                                         "text.vtk"));

}  // namespace
}  // namespace mlsmesh::test

// SPDX-License-Identifier: BSD-3-Clause
#include "common/mesh_reader.h"

#include "../core/test_shapes.h"
#include "common/app_error.h"
#include "common/mesh_io.h"
#include "program.h"

#include <gtest/gtest.h>
#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <cstdint>
#include <cstring>
#include <iterator>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

using apps::TriangleFile;
using core::Triangle;
using core::Vec3;

const std::string kPlyHead =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\n"
    "property double z\nelement face ";
const std::string kPlyVertices = "0 0 0\n1 0 0\n1 1 0\n0.1 1 0\n";

TriangleFile readText(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  return apps::readTriangles(folder.write(name, content));
}

std::string errorOf(const std::string& name, const std::string& content) {
  const TemporaryFolder folder;
  const std::string file = folder.write(name, content);
  try {
    apps::readTriangles(file);
  } catch (const apps::AppError& error) {
    EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

class MeshReaderFormat : public testing::TestWithParam<const char*> {};

TEST_P(MeshReaderFormat, ReadsWhatIsWritten) {
  const Soup soup = torus(9, 5);
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const Vec3& v : soup.vertices) {
    const Vec3 rounded = asFloats(v);
    cloud.emplace_back(static_cast<float>(rounded[0]), static_cast<float>(rounded[1]),
                       static_cast<float>(rounded[2]));
  }
  pcl::PolygonMesh mesh;
  pcl::toPCLPointCloud2(cloud, mesh.cloud);
  for (const auto& [a, b, c] : soup.triangles) {
    pcl::Vertices polygon;
    polygon.vertices = {a, b, c};
    mesh.polygons.push_back(polygon);
  }
  const TemporaryFolder folder;
  const std::string file = folder.file(std::string("torus.") + GetParam());
  apps::writeMesh(file, file, mesh);
  const TriangleFile read = apps::readTriangles(file);
  ASSERT_EQ(read.vertices.size(), soup.vertices.size());
  ASSERT_EQ(read.triangles.size(), soup.triangles.size());
  EXPECT_EQ(read.dropped_faces + read.polygons + read.non_finite_vertices, 0);
  for (std::size_t t = 0; t < soup.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(asFloats(read.vertices[read.triangles[t][i]]), asFloats(soup.vertices[soup.triangles[t][i]]));
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshReaderFormat, testing::Values("ply", "obj", "stl", "vtk", "vtp"));

TEST(MeshReader, KeepsDoubles) {
  const TriangleFile mesh =
      readText("a.ply", kPlyHead + "1\nproperty list uchar uint vertex_index\nend_header\n" + kPlyVertices +
                            "3 0 1 3\n");
  ASSERT_EQ(mesh.triangles.size(), 1U);
  EXPECT_EQ(mesh.vertices[3], Vec3(0.1, 1, 0));
  EXPECT_EQ(readText("a.obj", "v 0.1 4000000.25 1e-3\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").vertices[0],
            Vec3(0.1, 4000000.25, 1e-3));
}

TEST(MeshReader, CutsPolygonsAndDropsWhatIsNone) {
  const TriangleFile mesh =
      readText("a.ply", kPlyHead + "5\nproperty list uchar int vertex_indices\nend_header\n" + kPlyVertices +
                            "4 0 1 2 3\n3 0 1 2\n3 0 1 4\n3 0 1 -1\n2 0 1\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 1, 2}}));
  EXPECT_EQ(mesh.polygons, 1);
  EXPECT_EQ(mesh.dropped_faces, 3);
}

TEST(MeshReader, DropsFacesThatAreNotFinite) {
  const TriangleFile mesh = readText("a.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 1 3 4\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 2, 3}}));
  EXPECT_EQ(mesh.non_finite_vertices, 1);
  EXPECT_EQ(mesh.dropped_faces, 1);
  EXPECT_EQ(mesh.vertices[1], Vec3(0, 0, 0));
}

TEST(MeshReader, KeepsDegenerateFaces) {
  EXPECT_EQ(readText("a.obj", "v 0 0 0\nv 1 0 0\nf 1 1 2\n").triangles, (std::vector<Triangle>{{0, 0, 1}}));
  const TriangleFile stl =
      readText("a.stl",
               "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 0\nendloop\n"
               "endfacet\nendsolid a\n");
  EXPECT_EQ(stl.triangles, (std::vector<Triangle>{{0, 1, 0}}));
  EXPECT_EQ(stl.welded_vertices, 1);
}

TEST(MeshReader, TakesCornersOfObjInAllForms) {
  const TriangleFile mesh =
      readText("a.obj",
               "# a\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\nvt 0 0\nvn 0 0 1\nv 0 1 0\nf 1/1 2/1 3/1\n"
               "f 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\nf -3 -2 -1\nf 1 2 3 \n");
  EXPECT_EQ(mesh.triangles, std::vector<Triangle>(5, Triangle{0, 1, 2}));
}

TEST(MeshReader, TakesStripsApart) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
      "property float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
  const std::vector<Triangle> strip = {{0, 1, 2}, {2, 1, 3}, {1, 2, 3}};
  const std::string unsigned_head = std::string(head).replace(head.find("list int"), 8, "list uint");
  EXPECT_EQ(readText("a.ply", unsigned_head + kPlyVertices + "8 0 1 2 3 -1 1 2 3\n").triangles, strip);
  EXPECT_EQ(readText("a.ply", head + kPlyVertices + "8 0 1 2 3 -1 1 2 3\n").triangles, strip);
  EXPECT_EQ(readText("a.vtk", "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n" +
                                  kPlyVertices + "TRIANGLE_STRIPS 2 9\n4 0 1 2 3\n3 1 2 3\n")
                .triangles,
            strip);
}

TEST(MeshReader, FindsDamage) {
  const std::string list = "1\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(errorOf("a.ply", kPlyHead + list + kPlyVertices + "3 0 1\n").find("whole PLY"),
            std::string::npos);
  EXPECT_NE(errorOf("a.ply", kPlyHead + "9" + list.substr(1) + kPlyVertices + "3 0 1 2\n").find("cut off"),
            std::string::npos);
  EXPECT_NE(errorOf("a.ply", "solid a\n").find("not a PLY"), std::string::npos);
  EXPECT_NE(errorOf("a.obj", "v 0 0\n").find("line 1"), std::string::npos);
  EXPECT_NE(errorOf("a.obj", "f 1 2 3\n").find("no vertices"), std::string::npos);
  EXPECT_NE(errorOf("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n").find("endsolid"),
            std::string::npos);
  EXPECT_NE(errorOf("a.stl", "hello").find("not a STL"), std::string::npos);
  EXPECT_NE(errorOf("a.stl", std::string(80, '\0') + std::string("\x05\0\0\0", 4) + std::string(50, '\0'))
                .find("5 triangles"),
            std::string::npos);
  EXPECT_NE(errorOf("a.vtp", "hello").find("not a VTK XML"), std::string::npos);
  EXPECT_NE(errorOf("a.off", "OFF\n").find("'off'"), std::string::npos);
}

TEST(MeshReader, FindsDamageOfLegacyVtk) {
  const std::string head =
      "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n" + kPlyVertices;
  EXPECT_EQ(readText("a.vtk", head + "POLYGONS 1 4\n3 0 1 2\n").triangles.size(), 1U);
  EXPECT_NE(errorOf("a.vtk", head + "POLYGONS 1 4\n9 0 1 2\n").find("do not fit"), std::string::npos);
  EXPECT_NE(errorOf("a.vtk", head + "POLYGONS 1 5\n3 0 1 2 3\n").find("do not fill"), std::string::npos);
  EXPECT_NE(errorOf("a.vtk", head + "POLYGONS 2 8\n3 0 1 2\n").find("cut off"), std::string::npos);
  EXPECT_NE(
      errorOf("a.vtk", "# vtk DataFile Version 3.0\na\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 float\n" +
                           kPlyVertices)
          .find("POLYDATA"),
      std::string::npos);
  EXPECT_NE(errorOf("a.vtk", head + "POLYGONS 1 4\n3 0 1 x\n").find("'x' is not a number"),
            std::string::npos);
  EXPECT_NE(errorOf("a.vtk", head + "POLYGONS 1 4\n3 0 1 1.5\n").find("'1.5'"), std::string::npos);
  EXPECT_EQ(readText("a.vtk", std::string(head).replace(head.find("0.1"), 3, "nan")).non_finite_vertices, 1);
  EXPECT_EQ(
      readText("a.vtk", std::string(head).replace(head.find("3.0"), 3, "2.\x01") + "POLYGONS 1 4\n3 0 1 2\n")
          .triangles.size(),
      1U);
  EXPECT_EQ(readText("a.vtk", head + "POLYGONS 1 4\n3 0 1 7\n").dropped_faces, 1);
  const std::string newer = std::string(head).replace(head.find("3.0"), 3, "5.1");
  EXPECT_EQ(
      readText("a.vtk", newer + "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 3\nCONNECTIVITY vtktypeint64\n0 1 2\n")
          .triangles.size(),
      1U);
  errorOf("a.vtk", newer + "POLYGONS 2 3\nOFFSETS vtktypeint64\n0 900\nCONNECTIVITY vtktypeint64\n0 1 2\n");
}

template <class Number>
std::string bigEndian(const std::vector<Number>& numbers) {
  std::string bytes;
  for (const Number number : numbers) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(std::make_reverse_iterator(raw + sizeof number), std::make_reverse_iterator(raw));
  }
  return bytes;
}

TEST(MeshReader, ReadsTheNewerLayoutOfLegacyVtk) {
  const std::string head = "# vtk DataFile Version 5.1\na\nBINARY\nDATASET POLYDATA\nPOINTS 4 float\n" +
                           bigEndian<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) + "\n";
  const std::string cells = "POLYGONS 3 6\nOFFSETS vtktypeint64\n" + bigEndian<std::int64_t>({0, 3, 6}) +
                            "\nCONNECTIVITY vtktypeint64\n" + bigEndian<std::int64_t>({0, 1, 2, 0, 2, 3}) +
                            "\n";
  const std::vector<Triangle> square = {{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(readText("a.vtk", head + cells).triangles, square);
  const std::string metadata = "METADATA\nINFORMATION 0\n\n";
  const std::string more = "\nPOINT_DATA 4\nSCALARS broken\n";
  EXPECT_EQ(readText("a.vtk", head + metadata + cells + more).triangles, square) << "fields are left alone";
  EXPECT_NE(errorOf("a.vtk", head + cells.substr(0, cells.size() - 9)).find("cut off"), std::string::npos);
}

}  // namespace
}  // namespace mlsmesh::test

// SPDX-License-Identifier: BSD-3-Clause
// Whatever is in a file: an AppError that names it, or a cloud or mesh whose sizes agree; and no memory for
// what a header merely claims.
#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/cloud_io.h"
#include "common/mesh_reader.h"
#include "largest_allocation.h"
#include "program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace mlsmesh::test {
namespace {

namespace fs = std::filesystem;

/// Everything of the cloud is in its data.
void expectSound(const pcl::PCLPointCloud2& cloud) {
  const std::size_t points = apps::pointCount(cloud);
  EXPECT_GT(points, 0U);
  EXPECT_GE(cloud.data.size(), points * cloud.point_step);
  for (const pcl::PCLPointField& field : cloud.fields) {
    const std::size_t values = std::max<std::size_t>(field.count, 1);
    EXPECT_LE(field.offset + values * apps::sizeOfType(field.datatype), cloud.point_step) << field.name;
  }
}

void expectSound(const apps::TriangleFile& mesh) {
  for (const core::Vec3& vertex : mesh.vertices) EXPECT_TRUE(vertex.allFinite());
  for (const core::Triangle& triangle : mesh.triangles) {
    for (const core::Index corner : triangle) {
      EXPECT_GE(corner, 0);
      EXPECT_LT(static_cast<std::size_t>(corner), mesh.vertices.size());
    }
  }
}

/// What reading gave.
struct Reading {
  std::string error;  ///< empty if there is a cloud or mesh
  pcl::PCLPointCloud2 cloud;
  apps::TriangleFile mesh;
};

/// Files that are read in this process, in a folder of the test.
class HostileFiles : public testing::Test {
 protected:
  /// `kind`: "cloud_pcd", "mesh_ply", ...
  Reading read(const std::string& kind, const std::string& content) const {
    const std::size_t underscore = kind.find('_');
    const std::string file = folder_.write("input." + kind.substr(underscore + 1), content);
    Reading outcome;
    resetLargestAllocation();
    try {
      if (kind.rfind("cloud", 0) == 0) {
        apps::readCloud(file, outcome.cloud);
        expectSound(outcome.cloud);
      } else {
        outcome.mesh = apps::readTriangles(file);
        expectSound(outcome.mesh);
      }
    } catch (const apps::AppError& error) {
      outcome.error = error.what();
      EXPECT_EQ(outcome.error.rfind(file + ": ", 0), 0U) << outcome.error;
    }
    // VTK asks for what damaged heads of blocks in .vtp say, and gives it back untouched.
    if (!may_claim_) {
      EXPECT_LE(largestAllocation(), (std::size_t{16} << 20) + 100 * content.size());
    }
    return outcome;
  }

  void expectError(const std::string& kind, const std::string& content, const std::string& word) const {
    SCOPED_TRACE(kind + ": " + content.substr(0, 60));
    EXPECT_NE(read(kind, content).error.find(word), std::string::npos) << read(kind, content).error;
  }

  TemporaryFolder folder_;
  bool may_claim_ = false;
};

/// Good files, kind by kind: those that the fuzzers start from.
std::vector<fs::path> seeds() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(MLSMESH_SOURCE_DIR "/fuzz/corpus")) {
    const std::string kind = entry.path().parent_path().filename().string();
    if (entry.is_regular_file() && kind != "config" && kind.find('_') != std::string::npos &&
        (kind.rfind("cloud", 0) == 0 || kind.rfind("mesh", 0) == 0))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

class GoodFile : public HostileFiles, public testing::WithParamInterface<fs::path> {
 protected:
  std::string kind() const { return GetParam().parent_path().filename().string(); }
};

TEST_P(GoodFile, IsRead) {
  EXPECT_EQ(read(kind(), readFile(GetParam())).error, "");
}

TEST_P(GoodFile, CutAtEveryByte) {
  const std::string content = readFile(GetParam());
  for (std::size_t size = 0; size < content.size(); ++size) {
    read(kind(), content.substr(0, size));
    if (HasFailure()) FAIL() << "cut at " << size;
  }
}

TEST_P(GoodFile, WithWrongBytes) {
  const std::string content = readFile(GetParam());
  may_claim_ = kind().find("vtp") != std::string::npos;
  std::mt19937 random(1);
  const auto below = [&](std::size_t end) {
    return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
  };
  for (int trial = 0; trial < 400; ++trial) {
    std::string wrong = content;
    for (std::size_t i = 0, changes = 1 + below(4); i < changes; ++i) {
      const std::size_t place = below(wrong.size());
      static const std::string kLikely = "0123456789-+.eE \n\t\xff\x7f\x80";
      if (below(3) == 0) {
        wrong[place] = static_cast<char>(wrong[place] ^ (1 << below(8)));
      } else if (below(2) == 0) {
        wrong[place] = kLikely[below(kLikely.size())];
      } else {
        wrong.insert(place, below(2) == 0 ? "99999999" : wrong.substr(below(wrong.size()), below(20)));
      }
    }
    read(kind(), wrong);
    if (HasFailure()) FAIL() << "trial " << trial << ":\n" << wrong;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, GoodFile, testing::ValuesIn(seeds()), [](const auto& seed) {
  return seed.param.parent_path().filename().string() + "_" + seed.param.filename().string();
});

std::string pcdHead(const std::string& points, const std::string& storage) {
  return "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + points + "\nHEIGHT 1\nPOINTS " +
         points + "\nDATA " + storage + "\n";
}

/// A number as four bytes, lowest first.
std::string bytes(std::uint32_t value) {
  std::string text;
  for (int i = 0; i < 4; ++i) text += static_cast<char>(value >> (8 * i) & 255);
  return text;
}

const std::vector<std::string> kClaims = {
    "2147483647",           "2147483648",           "4294967295",
    "4294967296",           "9223372036854775807",  "9223372036854775808",
    "18446744073709551615", "18446744073709551616", "999999999999999"};

TEST_F(HostileFiles, PcdThatClaims) {
  for (const std::string& claim : kClaims)
    for (const char* storage : {"ascii", "binary", "binary_compressed"})
      EXPECT_NE(read("cloud_pcd", pcdHead(claim, storage) + "0 0 0\n").error, "") << claim << storage;
  expectError(
      "cloud_pcd",
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nWIDTH 65536\nHEIGHT 65536\nPOINTS 1\nDATA ascii\n0 0 0\n",
      "WIDTH x HEIGHT");
  expectError("cloud_pcd",
              "FIELDS x y z a\nSIZE 4 4 4 8\nTYPE F F F F\nCOUNT 1 1 1 999999\nWIDTH 1\nHEIGHT 1\nPOINTS 1\n"
              "DATA binary\n0123456789ab",
              "cut off");
  // A second FIELDS makes PCL forget the sizes.
  expectError(
      "cloud_pcd",
      "FIELDS x y z\nSIZE 1 1 1\nTYPE U U U\nFIELDS x y z\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\nabc",
      "FIELDS twice");
  expectError("cloud_pcd",
              "SIZE 4 4 4\nFIELDS x y z\nTYPE F F F\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ascii\n0 0 0\n",
              "SIZE before FIELDS");
}

TEST_F(HostileFiles, PcdWhoseDataGoOnAsAHeader) {
  // PCL takes these for further lines of the header, and crashes.
  for (const char* data : {"#\nDATA ascii\n", "\n# x\nFIELDS x y z a b c\n", "WIDTH 5\n"})
    expectError("cloud_pcd", pcdHead("2", "binary") + data + std::string(100, ' '), "behind DATA");
  EXPECT_EQ(read("cloud_pcd", pcdHead("2", "binary") + "#\nab" + std::string(20, '@')).error, "");
}

TEST_F(HostileFiles, CompressedPcdThatLies) {
  const std::string head = pcdHead("100000000", "binary_compressed");
  expectError("cloud_pcd", head + bytes(10) + bytes(1200000000) + "0123456789", "compressed data");
  expectError("cloud_pcd", pcdHead("1", "binary_compressed") + bytes(1000) + bytes(12) + "abc", "cut off");
  expectError("cloud_pcd",
              pcdHead("1", "binary_compressed") + bytes(4) + bytes(11) +
                  "\x02"
                  "abc",
              "compressed data");
  // A reference to before the start; a literal beyond the end; too few bytes.
  for (const std::string& data : {std::string("\x20\xff\x00\x00", 4),
                                  std::string("\x1f"
                                              "abc"),
                                  std::string("\x02"
                                              "abc")})
    EXPECT_NE(read("cloud_pcd", pcdHead("1", "binary_compressed") + bytes(4) + bytes(12) + data).error, "");
}

const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";

TEST_F(HostileFiles, PlyThatClaims) {
  for (const std::string& claim : kClaims) {
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      const std::string head = std::string("ply\nformat ") + format + " 1.0\n";
      const std::string vertex = "element vertex 1\n" + kXyz;
      const std::string data = "end_header\n0 0 0        \n";
      for (const char* kind : {"cloud_ply", "mesh_ply"}) {
        EXPECT_NE(read(kind, head + "element vertex " + claim + "\n" + kXyz + data).error, "") << claim;
        EXPECT_NE(read(kind, head + vertex + "element face " + claim +
                                 "\nproperty list uchar int vertex_indices\n" + data)
                      .error,
                  "");
        EXPECT_NE(read(kind, head + vertex + "element nothing " + claim + "\n" + data).error, "")
            << "would take for ever";
      }
    }
  }
  expectError("cloud_ply",
              "ply\nformat ascii 1.0\nelement vertex 1\n" + kXyz + "property int x\nend_header\n0 0 0 0\n",
              "'x' twice");
  expectError("cloud_ply",
              "ply\nformat ascii 1.0\nelement vertex 1\n" + kXyz + "element vertex 1\n" + kXyz +
                  "end_header\n0 0 0\n0 0 0\n",
              "'vertex' twice");
}

TEST_F(HostileFiles, PlyWhoseGridIsAnother) {
  // pcl::PLYReader makes the cloud as large as these numbers say.
  const std::string info = "obj_info num_cols 2000000000\nobj_info num_rows 2\n";
  const std::string vertex = "element vertex 2\n" + kXyz;
  const std::string camera = "element camera 1\nproperty int viewportx\nproperty int viewporty\n";
  for (const std::string& head :
       {info + vertex + "end_header\n0 0 0\n1 0 0\n", vertex + info + "end_header\n0 0 0\n1 0 0\n",
        vertex + camera + "end_header\n0 0 0\n1 0 0\n2000000000 2\n",
        vertex + camera + "end_header\n0 0 0\n1 0 0\n-1 -2\n"}) {
    const Reading outcome = read("cloud_ply", "ply\nformat ascii 1.0\n" + head);
    EXPECT_EQ(outcome.error, "");
    EXPECT_EQ(outcome.cloud.width, 2U);
    EXPECT_EQ(outcome.cloud.height, 1U);
  }
  const Reading grid =
      read("cloud_ply", "ply\nformat ascii 1.0\n" + vertex + camera + "end_header\n0 0 0\n1 0 0\n1 2\n");
  EXPECT_EQ(grid.cloud.width, 1U);
  EXPECT_EQ(grid.cloud.height, 2U);
}

TEST_F(HostileFiles, PlyInAnotherOrder) {
  // pcl::PLYReader mistakes such colours, and reads such lists over other fields.
  const Reading outcome =
      read("cloud_ply",
           "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar blue\nproperty list uchar int more\n" +
               kXyz + "property uchar red\nproperty uchar green\nend_header\n3 2 7 8 4 5 6 1 2\n");
  EXPECT_EQ(outcome.error, "");
  const auto slots = apps::fieldSlots(outcome.cloud);
  const std::map<std::string, double> expected = {{"x", 4},   {"y", 5},     {"z", 6},
                                                  {"red", 1}, {"green", 2}, {"blue", 3}};
  for (const auto& [name, value] : expected) {
    const apps::FieldSlot* slot = apps::findSlot(slots, name);
    ASSERT_NE(slot, nullptr) << name;
    EXPECT_EQ(apps::slotValue(outcome.cloud, *slot, 0), value) << name;
  }
}

TEST_F(HostileFiles, PlyWithBadRowsBehindOthers) {
  expectError("cloud_ply",
              "ply\nformat ascii 1.0\nelement first 1\nproperty int a\nelement vertex 1\n" + kXyz +
                  "end_header\n1\n0 zero 0\n",
              "line 11");
}

TEST_F(HostileFiles, LegacyVtkThatClaims) {
  const std::string head = "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\n";
  const std::string points = "POINTS 1 float\n0 0 0\n";
  for (const std::string& claim : kClaims) {
    for (const std::string& body :
         {"POINTS " + claim + " float\n0 0 0\n", "FIELD f " + claim + "\n",
          "FIELD f 1\na " + claim + " " + claim + " int\n1\n" + points,
          points + "LINES " + claim + " " + claim + "\n", points + "CELL_TYPES " + claim + "\n5\n",
          points + "VERTICES 1 " + claim + "\n1 0\n",
          points + "POINT_DATA " + claim + "\nSCALARS a int 1\nLOOKUP_TABLE default\n1\n",
          points + "POINT_DATA 1\nSCALARS a int " + claim + "\nLOOKUP_TABLE default\n1\n",
          points + "POINT_DATA 1\nLOOKUP_TABLE a " + claim + "\n1\n",
          points + "POINT_DATA 1\nFIELD f 1\na " + claim + " 1 int\n1\n"})
      EXPECT_NE(read("cloud_vtk", head + body).error, "") << body;
    EXPECT_NE(read("mesh_vtk", head + points + "POLYGONS " + claim + " " + claim + "\n").error, "") << claim;
  }
  for (const char* text : {"# vtk DataFile Version 3.0", "# vtk DataFile Version 3.0\n",
                           "# vtk DataFile Version 3.0\na", "# vtk DataFile Version 3.0\na\n"})
    expectError("cloud_vtk", text, "ASCII");
}

TEST_F(HostileFiles, LegacyVtkKeepsWhatIsNoNumber) {
  const Reading outcome =
      read("cloud_vtk",
           "# vtk DataFile Version 3.0\na\nASCII\nDATASET POLYDATA\nPOINTS 2 double\nnan inf 0\n1 2 3e-320\n"
           "POINT_DATA 2\nSCALARS a%20b unsigned_char 1\nLOOKUP_TABLE default\n300 -1\nSCALARS s string 1\n");
  EXPECT_EQ(outcome.error, "");
  const auto slots = apps::fieldSlots(outcome.cloud);
  ASSERT_EQ(slots.size(), 4U);
  EXPECT_TRUE(std::isnan(apps::slotValue(outcome.cloud, slots[0], 0)));
  EXPECT_TRUE(std::isinf(apps::slotValue(outcome.cloud, slots[1], 0)));
  EXPECT_EQ(apps::slotValue(outcome.cloud, slots[2], 1), 3e-320);
  EXPECT_EQ(slots[3].name, "a_b") << "a blank would end the name in the header of a PLY file";
  EXPECT_EQ(apps::slotValue(outcome.cloud, slots[3], 0), 255);
  EXPECT_EQ(apps::slotValue(outcome.cloud, slots[3], 1), 0);
}

TEST_F(HostileFiles, VtpThatClaims) {
  const std::string array =
      "<DataArray type=\"Float32\" NumberOfComponents=\"3\" format=\"ascii\">0 0 0</DataArray>";
  for (const std::string& claim : kClaims) {
    for (const char* count :
         {"NumberOfPoints", "NumberOfPolys", "NumberOfStrips", "NumberOfLines", "NumberOfVerts"}) {
      const std::string head =
          std::string("<VTKFile type=\"PolyData\"><PolyData><Piece ") + count + "=\"" + claim + "\">";
      for (const char* kind : {"cloud_vtp", "mesh_vtp"})
        EXPECT_NE(read(kind, head + "<Points>" + array + "</Points></Piece></PolyData></VTKFile>").error, "")
            << head;
    }
  }
}

TEST_F(HostileFiles, StlThatClaims) {
  for (const std::uint32_t claim : {1U, 0x7fffffffU, 0x80000000U, 0xffffffffU})
    expectError("mesh_stl", std::string(80, 'x') + bytes(claim) + std::string(49, '\0'), "cut off");
}

TEST_F(HostileFiles, StlTextThatLooksBinary) {
  // VTK takes it for binary because of its wild bytes, and text for the number of triangles.
  std::string text =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\n";
  EXPECT_EQ(read("mesh_stl", text + std::string(100, '\xf0') + "\nendsolid\n").mesh.triangles.size(), 1U);
  EXPECT_NE(read("mesh_stl", text + std::string(100, '\0') + "\nendsolid\n").error, "");
  expectError("mesh_stl", text.replace(text.find("vertex 1"), 8, "vortex 1") + "endsolid\n", "three corners");
}

TEST_F(HostileFiles, FewPointsAndLongLines) {
  for (int count = 1; count <= 3; ++count) {
    std::string rows;
    for (int i = 0; i < count; ++i) rows += "1 2 3\n";
    EXPECT_EQ(apps::pointCount(read("cloud_xyz", rows).cloud), static_cast<std::size_t>(count));
  }
  std::string wide;
  for (int i = 0; i < 20000; ++i) wide += "1 ";
  expectError("cloud_xyz", wide, "numbers in a line");
  expectError("cloud_xyz", "999999999999\n0 0 0\n", "announces");
  EXPECT_EQ(read("cloud_xyz", "1" + std::string(100000, '0') + " 0 0\n").error, "");
}

}  // namespace
}  // namespace mlsmesh::test

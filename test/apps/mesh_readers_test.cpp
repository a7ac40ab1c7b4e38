// SPDX-License-Identifier: BSD-3-Clause
// PCL's own readers open what mlsmesh_reconstruct writes.
#include "reconstruct_fixture.h"

#include <pcl/PolygonMesh.h>
#include <pcl/conversions.h>
#include <pcl/io/obj_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/io/vtk_lib_io.h>
#include <pcl/point_types.h>

namespace mlsmesh::test {

namespace {

class MeshReaders : public ReconstructTest {
 protected:
  /// Writes the sphere in the format and returns its path.
  std::string write(const std::string& extension) const {
    const std::string input = folder_.write("sphere.ply", spherePly(2000));
    std::string output = folder_.file("out." + extension);
    run({input, output, "--quiet"});
    return output;
  }

  /// A closed sphere; colours only where the format has them.
  static void expectSphere(const pcl::PolygonMesh& mesh, bool with_color) {
    pcl::PointCloud<pcl::PointXYZRGB> cloud;
    if (with_color) {
      pcl::fromPCLPointCloud2(mesh.cloud, cloud);
    } else {
      pcl::PointCloud<pcl::PointXYZ> positions;
      pcl::fromPCLPointCloud2(mesh.cloud, positions);
      for (const pcl::PointXYZ& p : positions) cloud.emplace_back(p.x, p.y, p.z, 0, 0, 0);
    }
    ASSERT_GT(cloud.size(), 300u);
    EXPECT_EQ(mesh.polygons.size(), 2 * cloud.size() - 4);
    for (const pcl::PointXYZRGB& p : cloud) {
      EXPECT_NEAR(p.getVector3fMap().norm(), 1, 0.01);
      if (!with_color) continue;
      EXPECT_NEAR(p.r, 127.5 * (p.x + 1), 12);
      EXPECT_NEAR(p.b, 127.5 * (p.z + 1), 12);
    }
  }
};

TEST_F(MeshReaders, Ply) {
  pcl::PolygonMesh mesh;
  ASSERT_EQ(pcl::io::loadPLYFile(write("ply"), mesh), 0);
  expectSphere(mesh, true);
  pcl::PolygonMesh by_vtk;
  ASSERT_GT(pcl::io::loadPolygonFilePLY(write("ply"), by_vtk), 0);
  expectSphere(by_vtk, true);
}

TEST_F(MeshReaders, Vtk) {
  pcl::PolygonMesh mesh;
  ASSERT_GT(pcl::io::loadPolygonFileVTK(write("vtk"), mesh), 0);
  expectSphere(mesh, true);
}

TEST_F(MeshReaders, Obj) {
  pcl::PolygonMesh mesh;
  ASSERT_GE(pcl::io::loadOBJFile(write("obj"), mesh), 0);
  expectSphere(mesh, false);
}

TEST_F(MeshReaders, Stl) {
  pcl::PolygonMesh mesh;
  ASSERT_GT(pcl::io::loadPolygonFileSTL(write("stl"), mesh), 0);
  expectSphere(mesh, false);
}

}  // namespace

}  // namespace mlsmesh::test

// SPDX-License-Identifier: BSD-3-Clause
#include <mlsmesh/mls_multiresolution.h>
#include <pcl/features/normal_3d.h>
#include <pcl/io/auto_io.h>
#include <pcl/point_types.h>
#include <pcl/surface/gp3.h>

int main(int argc, char** argv) {
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  if (argc != 2 || pcl::io::load(argv[1], *cloud) < 0) return 1;

  pcl::PolygonMesh ours, theirs;
  mlsmesh::MlsMultiresolution<pcl::PointXYZ> multiresolution;
  multiresolution.setInputCloud(cloud);
  multiresolution.reconstruct(ours);
  if (!multiresolution.status().ok()) std::cerr << multiresolution.status().message << '\n';

  pcl::PointCloud<pcl::PointNormal>::Ptr oriented(new pcl::PointCloud<pcl::PointNormal>);
  pcl::copyPointCloud(*cloud, *oriented);
  pcl::NormalEstimation<pcl::PointNormal, pcl::PointNormal> normals;
  normals.setInputCloud(oriented);
  normals.setKSearch(20);
  normals.compute(*oriented);
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> gp3;
  gp3.setInputCloud(oriented);
  gp3.setSearchRadius(5 * multiresolution.reconstruction().spacing);
  gp3.setMu(2.5);
  gp3.reconstruct(theirs);
  return pcl::io::savePLYFileBinary("ours.ply", ours) + pcl::io::savePLYFileBinary("gp3.ply", theirs);
}

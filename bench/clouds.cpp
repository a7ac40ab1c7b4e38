// SPDX-License-Identifier: BSD-3-Clause
#include "clouds.h"

#include <pcl/io/pcd_io.h>

#include <cmath>
#include <stdexcept>

#include "shapes/random.h"

namespace mlsmesh::bench {

Cloud::Ptr bumpySphere(std::size_t count) {
  constexpr double kRelief = 0.05;
  constexpr double kFrequency = 9;
  shapes::Random random(1);
  Cloud::Ptr cloud(new Cloud);
  cloud->resize(count);
  for (pcl::PointXYZ& point : *cloud) {
    const core::Vec3 direction = random.direction();
    const core::Vec3 waves = (kFrequency * direction).array().sin();
    point.getVector3fMap() = ((1 + kRelief * waves.prod()) * direction).cast<float>();
  }
  return cloud;
}

Cloud::Ptr readCloud(const std::string& file) {
  Cloud::Ptr cloud(new Cloud);
  if (pcl::io::loadPCDFile(file, *cloud) < 0) throw std::runtime_error(file + ": cannot be read as PCD");
  return cloud;
}

std::vector<core::Vec3> positionsOf(const Cloud& cloud) {
  std::vector<core::Vec3> positions;
  positions.reserve(cloud.size());
  for (const pcl::PointXYZ& point : cloud) positions.emplace_back(point.x, point.y, point.z);
  return positions;
}

}  // namespace mlsmesh::bench

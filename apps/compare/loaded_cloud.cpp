// SPDX-License-Identifier: BSD-3-Clause
#include "compare/loaded_cloud.h"

#include "common/app_error.h"
#include "common/cloud_io.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/vertex_cloud.h"

#include <algorithm>

namespace mlsmesh::apps {
namespace {

struct Positions {
  std::vector<core::Vec3> all;
  core::StoredAs stored_as = core::StoredAs::Float;
  std::size_t width = 0;
  std::size_t height = 0;
};

Positions readPositions(const std::filesystem::path& file) {
  pcl::PCLPointCloud2 cloud;
  readCloud(file, cloud);
  Positions positions;
  positions.width = cloud.width;
  positions.height = cloud.height;
  const Status status = core::guarded([&] { positions.all = worldPositions(cloud, positions.stored_as); });
  if (!status.ok()) throw fileError(file.string(), status.message);
  const bool is_empty = std::none_of(positions.all.begin(), positions.all.end(),
                                     [](const core::Vec3& place) { return place.allFinite(); });
  if (is_empty) throw fileError(file.string(), "holds no finite point; give another cloud");
  return positions;
}

}  // namespace

LoadedCloud loadCloud(const std::filesystem::path& file) {
  const Positions positions = readPositions(file);
  LoadedCloud loaded;
  loaded.width = positions.width;
  loaded.height = positions.height;
  PlainCloud::Ptr cloud(new PlainCloud), finite(new PlainCloud);
  for (const core::Vec3& place : positions.all) {
    const bool is_finite = place.allFinite();
    if (positions.stored_as == core::StoredAs::Double && is_finite && finite->empty()) loaded.origin = place;
    const Eigen::Vector3f moved = (place - loaded.origin).cast<float>();
    cloud->push_back({moved[0], moved[1], moved[2]});
    if (is_finite) finite->push_back(cloud->back());
  }
  cloud->is_dense = finite->size() == cloud->size();
  cloud->width = static_cast<std::uint32_t>(positions.width);
  cloud->height = static_cast<std::uint32_t>(positions.height);
  loaded.input.cloud = cloud;
  loaded.input.finite = finite;
  return loaded;
}

std::vector<core::Vec3> loadPoints(const std::filesystem::path& file) {
  std::vector<core::Vec3> points = readPositions(file).all;
  points.erase(std::remove_if(points.begin(), points.end(),
                              [](const core::Vec3& place) { return !place.allFinite(); }),
               points.end());
  return points;
}

}  // namespace mlsmesh::apps

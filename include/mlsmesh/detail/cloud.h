// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/point_set.h"

#include <pcl/PCLPointCloud2.h>
#include <pcl/PolygonMesh.h>
#include <pcl/common/io.h>
#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/types.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace mlsmesh::detail {

/// Type of the coordinates of a point type: float in all of PCL's, double in some of users'.
template <typename PointT>
constexpr core::StoredAs storedAs() {
  return std::is_same_v<decltype(PointT::x), double> ? core::StoredAs::Double : core::StoredAs::Float;
}

/// Writes x, y and z in the type of the point's coordinates.
template <typename PointT>
void setPosition(PointT& point, const core::Vec3& position) {
  using Scalar = decltype(PointT::x);
  point.x = static_cast<Scalar>(position.x());
  point.y = static_cast<Scalar>(position.y());
  point.z = static_cast<Scalar>(position.z());
}

/// PCL's indices in the core's type; those that do not fit become core::kNone, which no cloud has.
inline std::vector<core::Index> coreIndices(const pcl::Indices& indices) {
  std::vector<core::Index> result;
  result.reserve(indices.size());
  for (const auto index : indices) {
    const auto wide = static_cast<std::int64_t>(index);
    const bool fits = wide >= 0 && wide <= std::numeric_limits<core::Index>::max();
    result.push_back(fits ? static_cast<core::Index>(wide) : core::kNone);
  }
  return result;
}

/// The distinct finite points of `cloud`, of those named by `indices` alone unless it is null. Throws
/// core::Failure: NoInput for a null cloud, and all that core::makePointSet throws.
template <typename PointT>
core::PointSet pointSetOf(const typename pcl::PointCloud<PointT>::ConstPtr& cloud,
                          const pcl::Indices* indices, core::StoredAs stored_as, core::Context& context) {
  if (!cloud) throw core::Failure(StatusCode::NoInput, "no input cloud: call setInputCloud first");
  if (cloud->size() > static_cast<std::size_t>(std::numeric_limits<core::Index>::max())) {
    throw core::Failure(StatusCode::IndexOverflow,
                        "the input cloud has more points than 32-bit indices can name");
  }
  std::vector<core::Vec3> world;
  world.reserve(cloud->size());
  for (const PointT& point : *cloud) world.emplace_back(point.x, point.y, point.z);
  context.checkCancelled();
  if (!indices) return core::makePointSet(std::move(world), stored_as, nullptr, context);
  const std::vector<core::Index> chosen = coreIndices(*indices);
  return core::makePointSet(std::move(world), stored_as, &chosen, context);
}

/// The cloud with all fields of its point type. Unlike pcl::toPCLPointCloud2 it takes clouds whose width and
/// height were not kept up to date; they become unorganised.
template <typename PointT>
void toBlob(const pcl::PointCloud<PointT>& cloud, pcl::PCLPointCloud2& blob) {
  const std::size_t count = cloud.size();
  const bool organised = static_cast<std::size_t>(cloud.width) * cloud.height == count && cloud.height > 1;
  blob = pcl::PCLPointCloud2();
  pcl::for_each_type<typename pcl::traits::fieldList<PointT>::type>(
      pcl::detail::FieldAdder<PointT>(blob.fields));
  blob.header = cloud.header;
  blob.width = organised ? cloud.width : static_cast<pcl::uindex_t>(count);
  blob.height = organised ? cloud.height : 1;
  blob.point_step = sizeof(PointT);
  blob.row_step = blob.width * blob.point_step;
  blob.is_dense = cloud.is_dense;
  blob.data.resize(count * sizeof(PointT));
  if (count > 0) std::memcpy(blob.data.data(), cloud.points.data(), blob.data.size());
}

/// Replaces `cloud` by the points of `blob`, filling the fields that both have in the same type; the others
/// keep the value of a default-constructed point. Unlike pcl::fromPCLPointCloud2 it does not print what is
/// missing.
template <typename PointT>
void fromBlob(const pcl::PCLPointCloud2& blob, pcl::PointCloud<PointT>& cloud) {
  const auto isColour = [](const pcl::PCLPointField& field) {
    return field.name == "rgb" || field.name == "rgba";
  };
  pcl::MsgFieldMap map;
  for (const auto& to : pcl::getFields<PointT>()) {
    for (const auto& from : blob.fields) {
      const bool same = from.name == to.name && from.datatype == to.datatype && from.count == to.count;
      if (!same && !(isColour(from) && isColour(to))) continue;
      map.emplace_back();
      map.back().serialized_offset = from.offset;
      map.back().struct_offset = to.offset;
      map.back().size = static_cast<std::size_t>(pcl::getFieldSize(to.datatype)) * to.count;
      break;
    }
  }
  pcl::PointCloud<PointT> result;
  if (!blob.data.empty()) pcl::fromPCLPointCloud2(blob, result, map);
  cloud.swap(result);
}

/// Empties a cloud so that it is well formed: width = height = 0.
template <typename PointT>
void clear(pcl::PointCloud<PointT>& cloud, const pcl::PCLHeader& header = {}) {
  cloud.clear();
  cloud.header = header;
  cloud.width = 0;
  cloud.height = 0;
}

/// Empties a mesh so that it is well formed: no fields, no data, no polygons, width = height = 0.
inline void clear(pcl::PolygonMesh& mesh, const pcl::PCLHeader& header = {}) {
  mesh.header = header;
  mesh.cloud = pcl::PCLPointCloud2();
  mesh.cloud.header = header;
  mesh.polygons.clear();
}

}  // namespace mlsmesh::detail

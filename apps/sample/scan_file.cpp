// SPDX-License-Identifier: BSD-3-Clause
#include "sample/scan_file.h"

#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/cloud_columns.h"
#include "common/file_bytes.h"
#include "common/mesh_io.h"

#include <pcl/io/pcd_io.h>

#include <cstdio>
#include <locale>
#include <sstream>

namespace mlsmesh::apps {
namespace {

/// One coordinate of all, times `scale`.
std::vector<double> column(const std::vector<core::Vec3>& vectors, int axis, double scale) {
  std::vector<double> values;
  values.reserve(vectors.size());
  for (const core::Vec3& vector : vectors) values.push_back(scale * vector[axis]);
  return values;
}

pcl::PCLPointCloud2 toCloud(const std::vector<core::Vec3>& points, const std::vector<core::Vec3>& colors) {
  std::vector<CloudColumn> columns =
      coordinateColumns(column(points, 0, 1.0), column(points, 1, 1.0), column(points, 2, 1.0));
  if (!colors.empty()) {
    columns.push_back(
        colorColumn(column(colors, 0, 255.0), column(colors, 1, 255.0), column(colors, 2, 255.0)));
  }
  pcl::PCLPointCloud2 cloud;
  makeCloud(columns, cloud);
  return cloud;
}

/// By PCL's header: its writer crashes on a full disk, through its mapping of the file.
std::string toPcd(const pcl::PCLPointCloud2& cloud) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << pcl::PCDWriter().generateHeaderBinary(cloud, Eigen::Vector4f::Zero(),
                                                Eigen::Quaternionf::Identity())
       << "DATA binary\n";
  text.write(reinterpret_cast<const char*>(cloud.data.data()),
             static_cast<std::streamsize>(cloud.data.size()));
  return text.str();
}

std::string toText(const pcl::PCLPointCloud2& cloud) {
  const std::vector<FieldSlot> slots = fieldSlots(cloud);
  std::string text;
  char number[32];
  for (std::size_t point = 0; point < pointCount(cloud); ++point) {
    for (std::size_t i = 0; i < slots.size(); ++i) {
      std::snprintf(number, sizeof number, "%s%.9g", i == 0 ? "" : " ", slotValue(cloud, slots[i], point));
      text += number;
    }
    text += '\n';
  }
  return text;
}

}  // namespace

void checkScanType(const std::filesystem::path& output) {
  const std::string extension = extensionOf(output);
  if (extension == "pcd" || extension == "ply" || extension == "xyz") return;
  throw AppError(kExitUsage,
                 output.string() + ": unknown type of cloud; give a name that ends in .pcd, .ply or .xyz");
}

void writeScan(const std::vector<core::Vec3>& points, const std::vector<core::Vec3>& colors,
               const std::filesystem::path& output) {
  AtomicOutput file(output);
  const pcl::PCLPointCloud2 cloud = toCloud(points, colors);
  const std::string extension = extensionOf(output);
  if (extension == "pcd") {
    writeFile(file.temporary(), toPcd(cloud), output);
  } else if (extension == "ply") {
    pcl::PolygonMesh mesh;
    mesh.cloud = cloud;
    writeMesh(file.temporary(), output, mesh);
  } else {
    writeFile(file.temporary(), toText(cloud), output);
  }
  file.commit();
}

}  // namespace mlsmesh::apps

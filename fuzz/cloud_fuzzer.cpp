// SPDX-License-Identifier: BSD-3-Clause
// Whatever a file holds, it is read as a cloud whose sizes agree, or refused by an AppError.
#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/cloud_io.h"
#include "input_file.h"

#include <cstdlib>

namespace {

void checkCloud(const pcl::PCLPointCloud2& cloud) {
  const std::size_t points = mlsmesh::apps::pointCount(cloud);
  if (points == 0 || cloud.data.size() < points * cloud.point_step) std::abort();
  double sum = 0;
  for (const mlsmesh::apps::FieldSlot& slot : mlsmesh::apps::fieldSlots(cloud)) {
    if (slot.offset + mlsmesh::apps::sizeOfType(slot.datatype) > cloud.point_step) std::abort();
    for (std::size_t i = 0; i < points; ++i) sum += mlsmesh::apps::slotValue(cloud, slot, i);
  }
  const volatile double used = sum;
  static_cast<void>(used);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  pcl::PCLPointCloud2 cloud;
  try {
    mlsmesh::apps::readCloud(mlsmesh::fuzz::inputFile(data, size, MLSMESH_EXTENSION), cloud);
  } catch (const mlsmesh::apps::AppError&) {
    return 0;
  }
  checkCloud(cloud);
  return 0;
}

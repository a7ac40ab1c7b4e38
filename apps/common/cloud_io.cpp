// SPDX-License-Identifier: BSD-3-Clause
#include "common/cloud_io.h"

#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/file_bytes.h"
#include "common/header_check.h"
#include "common/ply_cloud.h"
#include "common/text_cloud.h"
#include "common/vtk_io.h"
#include "mlsmesh/core/types.h"

#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <new>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

/// Runs one of PCL's readers, which tell of trouble by a negative result or by an exception.
template <class Read>
void readWithPcl(const fs::path& file, const std::string& format, const Read& read) {
  int result = -1;
  try {
    result = read();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    throw damagedFile(file.string(), format);
  }
  if (result < 0) throw damagedFile(file.string(), format);
}

// Throws std::bad_alloc if there is no room for what PCL's reader takes, the file, its points and a copy of
// them: where there is none it calls the file damaged, or writes through a null pointer.
void checkRoom(const fs::path& file, std::uintmax_t point_bytes) {
  void* volatile room = std::malloc(static_cast<std::size_t>(fs::file_size(file) + 2 * point_bytes));
  if (room == nullptr) throw std::bad_alloc();
  std::free(room);
}

void readPcd(const fs::path& file, pcl::PCLPointCloud2& cloud) {
  checkRoom(file, checkPcdHeader(file));
  readWithPcl(file, "PCD", [&] { return pcl::PCDReader().read(file.string(), cloud); });
}

void readXyzFile(const fs::path& file, pcl::PCLPointCloud2& cloud) {
  readXyz(readBytes(file), file.string(), cloud);
}
void readObjFile(const fs::path& file, pcl::PCLPointCloud2& cloud) {
  readObj(readBytes(file), file.string(), cloud);
}

struct Format {
  const char* extension;
  void (*read)(const fs::path& file, pcl::PCLPointCloud2& cloud);
};

constexpr std::array<Format, 9> kFormats = {{{"pcd", readPcd},
                                             {"ply", readPlyCloud},
                                             {"obj", readObjFile},
                                             {"vtk", readVtk},
                                             {"vtp", readVtp},
                                             {"xyz", readXyzFile},
                                             {"txt", readXyzFile},
                                             {"pts", readXyzFile},
                                             {"asc", readXyzFile}}};

const Format& formatOf(const fs::path& file) {
  const std::string extension = extensionOf(file);
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw AppError(kExitUsage, file.string() + ": cannot read files of type '" + extension + "'; use one of " +
                                 readableFormats());
}

void checkPoints(const fs::path& file, const pcl::PCLPointCloud2& cloud) {
  for (const char* axis : {"x", "y", "z"}) {
    const pcl::PCLPointField* field = findField(cloud, axis);
    if (field == nullptr || sizeOfType(field->datatype) == 0) {
      throw fileError(file.string(), std::string("its points have no field '") + axis +
                                         "'; give a cloud with the fields x, y and z");
    }
  }
  if (pointCount(cloud) == 0) throw fileError(file.string(), "holds no points; give a file with points");
  if (pointCount(cloud) > static_cast<std::size_t>(std::numeric_limits<core::Index>::max()))
    throw fileError(file.string(), "has more points than 32-bit indices can name; thin it out first");
  bool is_whole = cloud.data.size() >= pointCount(cloud) * cloud.point_step;
  for (const pcl::PCLPointField& field : cloud.fields) {
    const std::size_t values = std::max<std::size_t>(field.count, 1);
    is_whole = is_whole && field.offset + values * sizeOfType(field.datatype) <= cloud.point_step;
  }
  if (!is_whole) throw damagedFile(file.string(), "point cloud");
}

}  // namespace

std::string readableFormats() {
  std::string list;
  for (const Format& format : kFormats) list += std::string(list.empty() ? "" : ", ") + format.extension;
  return list;
}

void checkReadableFormat(const fs::path& file) {
  formatOf(file);
}

void readCloud(const fs::path& file, pcl::PCLPointCloud2& cloud) {
  const Format& format = formatOf(file);
  checkReadable(file);
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  cloud = pcl::PCLPointCloud2();
  try {
    format.read(file, cloud);
  } catch (const std::bad_alloc&) {
    throw fileError(file.string(),
                    "does not fit into memory; use a smaller cloud, or check the sizes in its header");
  }
  checkPoints(file, cloud);
}

}  // namespace mlsmesh::apps

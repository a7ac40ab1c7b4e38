// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/cloud_columns.h"

#include <cstdint>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What VTK's files say of an array of point data.
struct PointArray {
  std::string name;
  std::uint8_t datatype = 0;  ///< pcl::PCLPointField::PointFieldTypes
  std::size_t components = 1;
  bool is_normals = false;
};

/// Its `values`, point by point, as columns: three or four bytes as a colour, normals as normal_x, normal_y,
/// normal_z, one component under its name, several as NAME_0, NAME_1, ...
void appendPointArray(const PointArray& array, const std::vector<double>& values,
                      std::vector<CloudColumn>& columns);

}  // namespace mlsmesh::apps

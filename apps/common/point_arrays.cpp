// SPDX-License-Identifier: BSD-3-Clause
#include "common/point_arrays.h"

namespace mlsmesh::apps {

void appendPointArray(const PointArray& array, const std::vector<double>& values,
                      std::vector<CloudColumn>& columns) {
  const std::size_t components = array.components;
  const auto component = [&](std::size_t index) {
    std::vector<double> column;
    column.reserve(values.size() / components);
    for (std::size_t i = index; i < values.size(); i += components) column.push_back(values[i]);
    return column;
  };
  if (array.datatype == pcl::PCLPointField::UINT8 && (components == 3 || components == 4)) {
    const std::vector<double> alpha = components == 4 ? component(3) : std::vector<double>();
    columns.push_back(
        colorColumn(component(0), component(1), component(2), components == 4 ? &alpha : nullptr));
    return;
  }
  for (std::size_t c = 0; c < components; ++c) {
    std::string field = components == 1 ? array.name : array.name + "_" + std::to_string(c);
    if (array.is_normals && components == 3) field = std::string("normal_") + "xyz"[c];
    columns.push_back({field, array.datatype, component(c)});
  }
}

}  // namespace mlsmesh::apps

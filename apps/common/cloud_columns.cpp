// SPDX-License-Identifier: BSD-3-Clause
#include "common/cloud_columns.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <type_traits>

namespace mlsmesh::apps {

namespace {

using Type = pcl::PCLPointField::PointFieldTypes;

/// Calls `use` with a value of the C++ type that a datatype stands for.
template <class Use>
void withType(std::uint8_t datatype, const Use& use) {
  switch (datatype) {
    case Type::BOOL:
    case Type::UINT8:
      return use(std::uint8_t{});
    case Type::INT8:
      return use(std::int8_t{});
    case Type::INT16:
      return use(std::int16_t{});
    case Type::UINT16:
      return use(std::uint16_t{});
    case Type::INT32:
      return use(std::int32_t{});
    case Type::UINT32:
      return use(std::uint32_t{});
    case Type::INT64:
      return use(std::int64_t{});
    case Type::UINT64:
      return use(std::uint64_t{});
    case Type::FLOAT32:
      return use(float{});
    case Type::FLOAT64:
      return use(double{});
    default:
      return;
  }
}

bool isColor(const std::string& name) {
  return name == "rgb" || name == "rgba";
}

/// `value` as the nearest value of a type; of an integer, NaN becomes 0.
template <class T>
T saturated(double value) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(value);
  } else {
    if (std::isnan(value)) return 0;
    // The largest integers of 64 bits round up to a double beyond them.
    if (value >= static_cast<double>(std::numeric_limits<T>::max())) return std::numeric_limits<T>::max();
    if (value <= static_cast<double>(std::numeric_limits<T>::min())) return std::numeric_limits<T>::min();
    return static_cast<T>(value);
  }
}

void store(const CloudColumn& column, double value, std::uint8_t* bytes) {
  // A packed colour is an integer, whatever type PCL gives the field.
  const std::uint8_t type = isColor(column.name) ? std::uint8_t{Type::UINT32} : column.datatype;
  withType(type, [&](auto zero) {
    const auto typed = saturated<decltype(zero)>(value);
    std::memcpy(bytes, &typed, sizeof typed);
  });
}

/// Largest coordinate range, and largest error of rounding to float, of a set of columns.
struct Rounding {
  double extent = 0;
  double error = 0;

  void add(const std::vector<double>& values) {
    double low = INFINITY;
    double high = -INFINITY;
    for (const double value : values) {
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
      // Through memory: GCC 12 takes a pair of vectorised conversions there and back for nothing.
      const volatile float rounded = static_cast<float>(value);
      error = std::max(error, std::abs(value - static_cast<double>(rounded)));
    }
    extent = std::max(extent, high - low);
  }
};

/// Without blanks and control characters, which end a name in the header of a file.
std::string fileName(const std::string& field) {
  if (field.rfind("normal_", 0) == 0 && field.size() == 8) return std::string("n") + field.back();
  std::string name = field;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c == 0x7f; }, '_');
  return name;
}

/// A name that comes again gets a number.
void makeUnique(std::vector<FieldSlot>& slots) {
  std::set<std::string> names;
  for (FieldSlot& slot : slots) {
    const std::string name = slot.name;
    for (int number = 2; !names.insert(slot.name).second; ++number)
      slot.name = name + "_" + std::to_string(number);
  }
}

void appendSlots(const pcl::PCLPointField& field, std::vector<FieldSlot>& slots) {
  const auto size = static_cast<std::uint32_t>(sizeOfType(field.datatype));
  if (field.name.empty() || field.name == "_" || size == 0) return;
  if (isColor(field.name) && size == 4) {
    // Packed as 0xAARRGGBB, little-endian.
    slots.push_back({"red", field.offset + 2, Type::UINT8});
    slots.push_back({"green", field.offset + 1, Type::UINT8});
    slots.push_back({"blue", field.offset, Type::UINT8});
    if (field.name == "rgba") slots.push_back({"alpha", field.offset + 3, Type::UINT8});
  } else if (field.count <= 1) {
    slots.push_back({fileName(field.name), field.offset, field.datatype});
  } else {
    for (std::uint32_t i = 0; i < field.count; ++i) {
      slots.push_back(
          {fileName(field.name) + "_" + std::to_string(i), field.offset + i * size, field.datatype});
    }
  }
}

}  // namespace

std::vector<CloudColumn> coordinateColumns(std::vector<double> x, std::vector<double> y,
                                           std::vector<double> z) {
  Rounding rounding;
  for (const auto* values : {&x, &y, &z}) rounding.add(*values);
  const bool fits = rounding.error <= 1e-6 * rounding.extent;
  const std::uint8_t type = fits ? Type::FLOAT32 : Type::FLOAT64;
  return {{"x", type, std::move(x)}, {"y", type, std::move(y)}, {"z", type, std::move(z)}};
}

CloudColumn colorColumn(const std::vector<double>& red, const std::vector<double>& green,
                        const std::vector<double>& blue, const std::vector<double>* alpha) {
  const auto byte = [](double value) {
    return std::isnan(value) ? 0 : static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 255.0)));
  };
  CloudColumn column;
  column.name = alpha ? "rgba" : "rgb";
  column.datatype = alpha ? Type::UINT32 : Type::FLOAT32;
  column.values.reserve(red.size());
  for (std::size_t i = 0; i < red.size(); ++i) {
    const std::uint32_t opacity = alpha ? byte((*alpha)[i]) : 0;
    column.values.push_back(opacity << 24 | byte(red[i]) << 16 | byte(green[i]) << 8 | byte(blue[i]));
  }
  return column;
}

void makeCloud(const std::vector<CloudColumn>& columns, pcl::PCLPointCloud2& cloud) {
  cloud = pcl::PCLPointCloud2();
  const std::size_t count = columns.empty() ? 0 : columns.front().values.size();
  for (const CloudColumn& column : columns) {
    pcl::PCLPointField field;
    field.name = column.name;
    field.offset = cloud.point_step;
    field.datatype = column.datatype;
    field.count = 1;
    cloud.fields.push_back(field);
    cloud.point_step += static_cast<std::uint32_t>(sizeOfType(column.datatype));
  }
  cloud.width = static_cast<std::uint32_t>(count);
  cloud.height = 1;
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.is_dense = 0;
  cloud.data.resize(count * cloud.point_step);
  for (std::size_t c = 0; c < columns.size(); ++c) {
    for (std::size_t i = 0; i < count; ++i) {
      store(columns[c], columns[c].values[i], &cloud.data[i * cloud.point_step + cloud.fields[c].offset]);
    }
  }
}

const pcl::PCLPointField* findField(const pcl::PCLPointCloud2& cloud, const std::string& name) {
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

std::vector<FieldSlot> fieldSlots(const pcl::PCLPointCloud2& cloud) {
  std::vector<FieldSlot> slots;
  for (const pcl::PCLPointField& field : cloud.fields) appendSlots(field, slots);
  makeUnique(slots);
  return slots;
}

const FieldSlot* findSlot(const std::vector<FieldSlot>& slots, const std::string& name) {
  for (const FieldSlot& slot : slots) {
    if (slot.name == name) return &slot;
  }
  return nullptr;
}

std::size_t sizeOfType(std::uint8_t datatype) {
  std::size_t size = 0;
  withType(datatype, [&](auto zero) { size = sizeof zero; });
  return size;
}

double slotValue(const pcl::PCLPointCloud2& cloud, const FieldSlot& slot, std::size_t point) {
  double value = 0;
  withType(slot.datatype, [&](auto typed) {
    std::memcpy(&typed, &cloud.data[point * cloud.point_step + slot.offset], sizeof typed);
    value = static_cast<double>(typed);
  });
  return value;
}

std::size_t pointCount(const pcl::PCLPointCloud2& cloud) {
  return static_cast<std::size_t>(cloud.width) * cloud.height;
}

bool hasDoubleCoordinates(const pcl::PCLPointCloud2& cloud) {
  return std::any_of(cloud.fields.begin(), cloud.fields.end(), [](const pcl::PCLPointField& field) {
    return (field.name == "x" || field.name == "y" || field.name == "z") && field.datatype == Type::FLOAT64;
  });
}

}  // namespace mlsmesh::apps

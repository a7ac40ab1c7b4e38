// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/PCLPointCloud2.h>

#include <cstdint>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// Values of one scalar field of a cloud, or its packed colour.
struct CloudColumn {
  std::string name;
  std::uint8_t datatype = 0;  ///< pcl::PCLPointField::PointFieldTypes
  std::vector<double> values;
};

/// Three columns x, y, z of doubles: stored as float32, or as float64 where rounding to float32 would move a
/// point by more than 1e-6 of the cloud's extent (large offsets, as in UTM).
std::vector<CloudColumn> coordinateColumns(std::vector<double> x, std::vector<double> y,
                                           std::vector<double> z);

/// PCL's colour field: "rgb", or "rgba" if `alpha` is not null, from components 0 .. 255 (clamped, rounded).
CloudColumn colorColumn(const std::vector<double>& red, const std::vector<double>& green,
                        const std::vector<double>& blue, const std::vector<double>* alpha = nullptr);

/// An unorganised cloud with one field a column, in order; all columns are equally long. Values beyond the
/// type of an integer become its nearest.
void makeCloud(const std::vector<CloudColumn>& columns, pcl::PCLPointCloud2& cloud);

/// The field of that name, or null.
const pcl::PCLPointField* findField(const pcl::PCLPointCloud2& cloud, const std::string& name);

/// A scalar of a point as it is written to a file: where it lies in the point's bytes, its type, its name
/// there.
struct FieldSlot {
  std::string name;
  std::uint32_t offset = 0;
  std::uint8_t datatype = 0;
};

/// All scalars of a cloud in order: rgb and rgba taken apart into red, green, blue (and alpha) bytes,
/// normal_x, normal_y, normal_z called nx, ny, nz, further values of a field of several called NAME_0,
/// NAME_1, ...; padding left out. Names have no blanks, and none comes twice.
std::vector<FieldSlot> fieldSlots(const pcl::PCLPointCloud2& cloud);

/// The slot of that name, or null.
const FieldSlot* findSlot(const std::vector<FieldSlot>& slots, const std::string& name);

/// Bytes of a value of that type; 0 if the type is unknown.
std::size_t sizeOfType(std::uint8_t datatype);

/// The value in a slot of point `point`, as a double.
double slotValue(const pcl::PCLPointCloud2& cloud, const FieldSlot& slot, std::size_t point);

std::size_t pointCount(const pcl::PCLPointCloud2& cloud);

/// Whether x, y or z is stored as float64.
bool hasDoubleCoordinates(const pcl::PCLPointCloud2& cloud);

}  // namespace mlsmesh::apps

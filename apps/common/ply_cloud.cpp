// SPDX-License-Identifier: BSD-3-Clause
#include "common/ply_cloud.h"

#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/header_check.h"
#include "common/ply_scalars.h"

#include <pcl/io/ply/ply_parser.h>
#include <pcl/type_traits.h>

#include <array>
#include <cstring>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace mlsmesh::apps {

namespace {

namespace ply = pcl::io::ply;
using Parser = ply::ply_parser;
using Type = pcl::PCLPointField::PointFieldTypes;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Where the byte of a colour lies in its four (0xAARRGGBB, little-endian); kNone if it is another name.
std::uint32_t placeOfColor(std::string name) {
  static const std::array<const char*, 4> kNames = {"blue", "green", "red", "alpha"};
  if (name.rfind("diffuse_", 0) == 0) name.erase(0, 8);
  for (std::uint32_t i = 0; i < kNames.size(); ++i)
    if (name == kNames[i]) return i;
  return kNone;
}

/// Takes the vertices that the parser finds, row by row.
class VertexRows {
 public:
  void attachTo(Parser& parser) {
    parser.element_definition_callback([this](const std::string& name, std::size_t) {
      return Parser::element_callbacks_type([] {},
                                            [this, is_vertex = name == "vertex"] {
                                              if (is_vertex) endRow();
                                            });
    });
    parser.obj_info_callback([this](const std::string& line) { takeInfo(line); });
    attachPlyScalars(parser, [this](auto type, const std::string& element, const std::string& name) {
      return scalar<decltype(type)>(element, name);
    });
  }

  std::size_t count() const { return count_; }

  /// Hands over what was found.
  void moveTo(pcl::PCLPointCloud2& cloud) {
    if (has_color_) addColorFields();
    cloud.fields = std::move(fields_);
    cloud.point_step = static_cast<std::uint32_t>(row_.size());
    const bool is_grid = columns_ > 0 && rows_ > 0 && columns_ * rows_ == static_cast<double>(count_);
    cloud.width = static_cast<std::uint32_t>(is_grid ? columns_ : static_cast<double>(count_));
    cloud.height = static_cast<std::uint32_t>(is_grid ? rows_ : 1);
    cloud.row_step = cloud.width * cloud.point_step;
    cloud.is_dense = 0;
    cloud.data = std::move(data_);
  }

 private:
  template <class Value>
  std::function<void(Value)> scalar(const std::string& element, const std::string& name) {
    if (element == "camera" && name == "viewportx")
      return [this](Value value) { columns_ = static_cast<double>(value); };
    if (element == "camera" && name == "viewporty")
      return [this](Value value) { rows_ = static_cast<double>(value); };
    if (element != "vertex") return nullptr;
    const std::uint32_t place = std::is_same_v<Value, ply::uint8> ? placeOfColor(name) : kNone;
    const std::size_t offset = place == kNone ? addField<Value>(name) : addColor(name, place);
    return [this, offset](Value value) { std::memcpy(&row_[offset], &value, sizeof value); };
  }

  template <class Value>
  std::size_t addField(const std::string& name) {
    const std::size_t offset = row_.size();
    const bool is_normal = name == "nx" || name == "ny" || name == "nz";
    addFieldAt(is_normal ? "normal_" + name.substr(1) : name, offset, pcl::traits::asEnum_v<Value>);
    row_.resize(offset + sizeof(Value));
    return offset;
  }

  std::size_t addColor(const std::string& name, std::uint32_t place) {
    if (!has_color_) {
      has_color_ = true;
      color_at_ = row_.size();
      color_field_ = fields_.size();
      row_.resize(color_at_ + color_names_.size());
    }
    color_names_[place] = name;
    return color_at_ + place;
  }

  /// As one field, if the colour is whole, in the place of its first byte.
  void addColorFields() {
    const bool is_whole = !color_names_[0].empty() && !color_names_[1].empty() && !color_names_[2].empty();
    const bool has_alpha = !color_names_[3].empty();
    std::vector<pcl::PCLPointField> behind(fields_.begin() + static_cast<std::ptrdiff_t>(color_field_),
                                           fields_.end());
    fields_.resize(color_field_);
    if (is_whole) addFieldAt(has_alpha ? "rgba" : "rgb", color_at_, has_alpha ? Type::UINT32 : Type::FLOAT32);
    for (std::size_t i = 0; i < color_names_.size() && !is_whole; ++i)
      if (!color_names_[i].empty()) addFieldAt(color_names_[i], color_at_ + i, Type::UINT8);
    fields_.insert(fields_.end(), behind.begin(), behind.end());
  }

  void addFieldAt(const std::string& name, std::size_t offset, std::uint8_t datatype) {
    pcl::PCLPointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(offset);
    field.datatype = datatype;
    field.count = 1;
    fields_.push_back(field);
  }

  /// "obj_info num_cols N".
  void takeInfo(const std::string& line) {
    std::istringstream words(line);
    std::string keyword, name;
    double value = 0;
    if (!(words >> keyword >> name >> value)) return;
    if (name == "num_cols") columns_ = value;
    if (name == "num_rows") rows_ = value;
  }

  void endRow() {
    data_.insert(data_.end(), row_.begin(), row_.end());
    ++count_;
  }

  std::vector<pcl::PCLPointField> fields_;
  std::vector<std::uint8_t> row_;  ///< of the vertex that is being read
  std::vector<std::uint8_t> data_;
  std::size_t count_ = 0;
  bool has_color_ = false;
  std::size_t color_at_ = 0;     ///< its first byte in a row
  std::size_t color_field_ = 0;  ///< the field that it becomes
  std::array<std::string, 4> color_names_;
  double columns_ = 0;
  double rows_ = 0;
};

}  // namespace

void readPlyCloud(const std::filesystem::path& file, pcl::PCLPointCloud2& cloud) {
  const std::size_t announced = checkPlyHeader(file);
  VertexRows rows;
  Parser parser;
  rows.attachTo(parser);
  if (!parser.parse(file.string()) || rows.count() != announced) throw damagedFile(file.string(), "PLY");
  rows.moveTo(cloud);
}

}  // namespace mlsmesh::apps

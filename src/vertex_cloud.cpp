// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/vertex_cloud.h"

#include "mlsmesh/core/failure.h"

#include <boost/predef/other/endian.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>

namespace mlsmesh {

namespace {

using core::Failure;
using core::Index;
using core::Vec3;
using pcl::PCLPointField;
using Byte = std::uint8_t;

// Calls visit(T()) with the numeric type of a field; false if PCL knows no such type.
template <typename Visit>
bool withType(Byte datatype, const Visit& visit) {
  switch (datatype) {  // NOLINT(bugprone-branch-clone): the types differ
    case PCLPointField::BOOL:
      return visit(bool()), true;
    case PCLPointField::INT8:
      return visit(std::int8_t()), true;
    case PCLPointField::UINT8:
      return visit(std::uint8_t()), true;
    case PCLPointField::INT16:
      return visit(std::int16_t()), true;
    case PCLPointField::UINT16:
      return visit(std::uint16_t()), true;
    case PCLPointField::INT32:
      return visit(std::int32_t()), true;
    case PCLPointField::UINT32:
      return visit(std::uint32_t()), true;
    case PCLPointField::INT64:
      return visit(std::int64_t()), true;
    case PCLPointField::UINT64:
      return visit(std::uint64_t()), true;
    case PCLPointField::FLOAT32:
      return visit(float()), true;
    case PCLPointField::FLOAT64:
      return visit(double()), true;
    default:
      return false;
  }
}

// Bytes of one element, 0 for an unknown type.
std::size_t elementSize(Byte datatype) {
  std::size_t size = 0;
  withType(datatype, [&](auto type) { size = sizeof(type); });
  return size;
}

// Old writers leave the count of a single element at 0.
std::size_t elementCount(const PCLPointField& field) {
  return std::max<std::size_t>(field.count, 1);
}

std::size_t fieldSize(const PCLPointField& field) {
  return elementSize(field.datatype) * elementCount(field);
}

template <typename T>
T load(const Byte* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

template <typename T>
void store(Byte* to, T value) {
  std::memcpy(to, &value, sizeof(T));
}

// A blob that was checked, so that every field of every point can be read.
class Source {
 public:
  explicit Source(const pcl::PCLPointCloud2& cloud) : cloud_(cloud) {
    const std::size_t row = width() * cloud.point_step;
    const std::size_t bytes = size() == 0 ? 0 : rowStep() * (cloud.height - 1) + row;
    if (cloud.data.size() < bytes || (cloud.height > 1 && rowStep() < row)) {
      fail("the cloud holds " + std::to_string(cloud.data.size()) + " bytes, but its sizes say " +
           std::to_string(bytes));
    }
    if (size() > 0 && (cloud.is_bigendian != 0) != (BOOST_ENDIAN_BIG_BYTE != 0)) {
      fail("the cloud's numbers are in the byte order of another machine; convert them first");
    }
  }

  std::size_t size() const { return width() * cloud_.height; }
  const pcl::PCLPointCloud2& cloud() const { return cloud_; }

  // Null if there is no readable field of that name.
  const PCLPointField* find(const std::string& name) const {
    for (const PCLPointField& field : cloud_.fields) {
      if (field.name == name && readable(field)) return &field;
    }
    return nullptr;
  }

  bool readable(const PCLPointField& field) const {
    return fieldSize(field) > 0 && field.offset + fieldSize(field) <= cloud_.point_step;
  }

  const Byte* at(std::size_t point, const PCLPointField& field) const {
    const std::size_t row = cloud_.height > 1 ? point / width() : 0;
    return cloud_.data.data() + row * rowStep() + (point - row * width()) * cloud_.point_step + field.offset;
  }

 private:
  [[noreturn]] static void fail(const std::string& what) { throw Failure(StatusCode::EmptyInput, what); }

  std::size_t width() const { return cloud_.width; }
  std::size_t rowStep() const { return cloud_.row_step; }

  const pcl::PCLPointCloud2& cloud_;
};

// A field of the output; `from` is the input's field that it carries, null where it is computed.
struct Column {
  PCLPointField to;
  const PCLPointField* from = nullptr;
};

bool oneOf(const std::string& name, std::initializer_list<const char*> names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool isPackedColour(const PCLPointField& field) {
  return oneOf(field.name, {"rgb", "rgba"}) && fieldSize(field) == 4 && elementCount(field) == 1;
}

bool isByteColour(const PCLPointField& field) {
  return oneOf(field.name, {"r", "g", "b", "a", "red", "green", "blue", "alpha"}) && fieldSize(field) == 1;
}

bool isIntensity(const PCLPointField& field) {
  return field.name == "intensity" && elementCount(field) == 1;
}

// Fills the output column by column, each in one strided loop.
class VertexCloudWriter {
 public:
  VertexCloudWriter(const Source& input, const VertexData& data, const VertexSources& sources,
                    const core::Context& context, pcl::PCLPointCloud2& output)
      : input_(input),
        data_(data),
        sources_(sources),
        context_(context),
        output_(output),
        count_(data.position.size()) {
    checkSources();
    planColumns();
    layOut();
  }

  void write() {
    for (const Column& column : columns_) {
      context_.checkCancelled();
      if (!column.from) continue;
      if (isPackedColour(*column.from) || isByteColour(*column.from)) {
        averageBytes(column);
      } else if (isIntensity(*column.from)) {
        withType(column.to.datatype, [&](auto type) { averageNumbers<decltype(type)>(column); });
      } else {
        copyNearest(column);
      }
    }
    writeComputed();
  }

 private:
  void checkSources() const {
    const auto valid = [&](Index index) {
      return index >= 0 && static_cast<std::size_t>(index) < input_.size();
    };
    const auto& nearest = sources_.nearest;
    const auto& members = sources_.members.items;
    if (nearest.size() != count_ || !std::all_of(nearest.begin(), nearest.end(), valid) ||
        !std::all_of(members.begin(), members.end(), valid)) {
      throw Failure(StatusCode::Internal, "a vertex refers to points that the input does not have");
    }
  }

  void planColumns() {
    for (const PCLPointField& field : input_.cloud().fields) {
      if (field.name != "_" && input_.readable(field)) columns_.push_back({field, &field});
    }
    const bool doubles = data_.stored_as == core::StoredAs::Double;
    for (const char* name : {"x", "y", "z"})
      compute(name, doubles ? PCLPointField::FLOAT64 : PCLPointField::FLOAT32);
    if (!data_.normal.empty()) {
      for (const char* name : {"normal_x", "normal_y", "normal_z"}) compute(name, PCLPointField::FLOAT32);
    }
    if (!data_.curvature.empty()) compute("curvature", PCLPointField::FLOAT32);
    if (!data_.cluster_size.empty()) compute("cluster_size", PCLPointField::UINT32);
  }

  void compute(const char* name, PCLPointField::PointFieldTypes datatype) {
    const auto named = [&](const Column& column) { return column.to.name == name; };
    auto column = std::find_if(columns_.begin(), columns_.end(), named);
    if (column == columns_.end()) column = columns_.insert(columns_.end(), Column());
    column->to.name = name;
    column->to.datatype = static_cast<Byte>(datatype);
    column->to.count = 1;
    column->from = nullptr;
  }

  void layOut() {
    std::size_t offset = 0, alignment = 1;
    for (Column& column : columns_) {
      const std::size_t element = elementSize(column.to.datatype);
      offset = roundUp(offset, element);
      alignment = std::max(alignment, element);
      column.to.offset = static_cast<pcl::uindex_t>(offset);
      column.to.count = static_cast<pcl::uindex_t>(elementCount(column.to));
      offset += fieldSize(column.to);
    }
    step_ = roundUp(offset, alignment);
    if (step_ * count_ > std::numeric_limits<pcl::uindex_t>::max()) {
      throw Failure(StatusCode::IndexOverflow, "the vertices take more bytes than a PCLPointCloud2 can hold");
    }
    output_ = pcl::PCLPointCloud2();
    output_.header = input_.cloud().header;
    for (const Column& column : columns_) output_.fields.push_back(column.to);
    output_.width = static_cast<pcl::uindex_t>(count_);
    output_.height = count_ > 0 ? 1 : 0;
    output_.point_step = static_cast<pcl::uindex_t>(step_);
    output_.row_step = static_cast<pcl::uindex_t>(step_ * count_);
    output_.is_dense = 1;
    output_.data.resize(step_ * count_);
  }

  static std::size_t roundUp(std::size_t value, std::size_t multiple) {
    return (value + multiple - 1) / multiple * multiple;
  }

  Byte* at(std::size_t vertex, const Column& column) const {
    return output_.data.data() + vertex * step_ + column.to.offset;
  }

  bool hasParents(std::size_t vertex) const {
    return vertex < sources_.parents.size() && sources_.parents[vertex][0] != sources_.parents[vertex][1];
  }

  Index memberCount(std::size_t vertex) const {
    return vertex < static_cast<std::size_t>(sources_.members.count())
               ? sources_.members.size(static_cast<Index>(vertex))
               : 0;
  }

  const Index* members(std::size_t vertex) const { return sources_.members.data(static_cast<Index>(vertex)); }

  void copyNearest(const Column& column) {
    core::CancelCheck check(context_);
    for (std::size_t v = 0; v < count_; ++v) {
      check();
      copyNearest(column, v);
    }
  }

  void copyNearest(const Column& column, std::size_t v) {
    std::memcpy(at(v, column), input_.at(sources_.nearest[v], *column.from), fieldSize(column.to));
  }

  void averageBytes(const Column& column) {
    core::CancelCheck check(context_);
    const std::size_t channels = fieldSize(column.to);
    for (std::size_t v = 0; v < count_; ++v) {
      check();
      if (!hasParents(v) && memberCount(v) == 0) {
        copyNearest(column, v);
        continue;
      }
      for (std::size_t channel = 0; channel < channels; ++channel) {
        at(v, column)[channel] = averageByte(column, v, channel);
      }
    }
  }

  Byte averageByte(const Column& column, std::size_t v, std::size_t channel) const {
    std::uint64_t sum = 0, count = 2;
    if (hasParents(v)) {
      for (const Index parent : sources_.parents[v]) sum += at(parent, column)[channel];
    } else {
      count = static_cast<std::uint64_t>(memberCount(v));
      for (Index i = 0; i < memberCount(v); ++i) sum += input_.at(members(v)[i], *column.from)[channel];
    }
    return static_cast<Byte>((2 * sum + count) / (2 * count));
  }

  // Values that are not finite do not count. Sorting makes the sum independent of the order of the members.
  template <typename T>
  void averageNumbers(const Column& column) {
    core::CancelCheck check(context_);
    std::vector<double> values;
    for (std::size_t v = 0; v < count_; ++v) {
      check();
      values.clear();
      const auto take = [&](const Byte* from) {
        const double value = static_cast<double>(load<T>(from));
        if (std::isfinite(value)) values.push_back(value);
      };
      if (hasParents(v)) {
        for (const Index parent : sources_.parents[v]) take(at(parent, column));
      } else {
        for (Index i = 0; i < memberCount(v); ++i) take(input_.at(members(v)[i], *column.from));
      }
      if (values.empty()) {
        copyNearest(column, v);
        continue;
      }
      std::sort(values.begin(), values.end());
      double sum = 0;
      for (const double value : values) sum += value;
      const double mean = sum / static_cast<double>(values.size());
      store(at(v, column), static_cast<T>(std::is_floating_point_v<T> ? mean : std::round(mean)));
    }
  }

  void writeComputed() {
    static constexpr const char* kAxes[] = {"x", "y", "z"};
    static constexpr const char* kNormals[] = {"normal_x", "normal_y", "normal_z"};
    const bool doubles = data_.stored_as == core::StoredAs::Double;
    for (int axis = 0; axis < 3; ++axis) {
      const auto coordinate = [&](std::size_t v) { return data_.position[v][axis]; };
      doubles ? fill<double>(kAxes[axis], coordinate) : fill<float>(kAxes[axis], coordinate);
      if (data_.normal.empty()) continue;
      fill<float>(kNormals[axis], [&](std::size_t v) { return data_.normal[v][axis]; });
    }
    if (!data_.curvature.empty()) fill<float>("curvature", [&](std::size_t v) { return data_.curvature[v]; });
    if (!data_.cluster_size.empty()) {
      fill<std::uint32_t>("cluster_size", [&](std::size_t v) { return data_.cluster_size[v]; });
    }
  }

  template <typename T, typename Value>
  void fill(const char* name, const Value& value) {
    for (const Column& column : columns_) {
      if (column.to.name != name || column.from) continue;
      context_.checkCancelled();
      for (std::size_t v = 0; v < count_; ++v) store(at(v, column), static_cast<T>(value(v)));
    }
  }

  const Source& input_;
  const VertexData& data_;
  const VertexSources& sources_;
  const core::Context& context_;
  pcl::PCLPointCloud2& output_;
  const std::size_t count_;
  std::vector<Column> columns_;
  std::size_t step_ = 0;
};

void checkLevel(const core::RefinedMesh& mesh, Index level) {
  if (level >= 0 && level < mesh.levelCount()) return;
  throw Failure(StatusCode::InvalidParameter,
                "there is no level " + std::to_string(level) + " of " + std::to_string(mesh.levelCount()));
}

// Curvature of the representatives; on the edges between them the mean of the ends.
std::vector<double> levelCurvature(const core::Reconstruction& reconstruction, std::size_t count) {
  const std::vector<double>& variation = reconstruction.representatives.variation;
  std::vector<double> curvature;
  if (variation.empty()) return curvature;
  curvature.reserve(count);
  for (std::size_t v = 0; v < count; ++v) {
    const auto [a, b] = reconstruction.mesh.parents[v];
    const bool original = v < reconstruction.representative_of.size();
    curvature.push_back(original ? variation[reconstruction.representative_of[v]]
                                 : 0.5 * (curvature[a] + curvature[b]));
  }
  return curvature;
}

}  // namespace

std::vector<Vec3> worldPositions(const pcl::PCLPointCloud2& cloud, core::StoredAs& stored_as,
                                 const core::Context& context) {
  const Source source(cloud);
  std::vector<Vec3> positions(source.size());
  stored_as = core::StoredAs::Float;
  const char* const names[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const PCLPointField* field = source.find(names[axis]);
    if (!field)
      throw Failure(StatusCode::EmptyInput, std::string("the cloud has no field '") + names[axis] + "'");
    if (field->datatype == PCLPointField::FLOAT64) stored_as = core::StoredAs::Double;
    context.checkCancelled();
    withType(field->datatype, [&](auto type) {
      for (std::size_t i = 0; i < positions.size(); ++i) {
        positions[i][axis] = static_cast<double>(load<decltype(type)>(source.at(i, *field)));
      }
    });
  }
  return positions;
}

void makeVertexCloud(const pcl::PCLPointCloud2& input, const VertexData& data, const VertexSources& sources,
                     pcl::PCLPointCloud2& output, const core::Context& context) {
  const Source source(input);
  VertexCloudWriter(source, data, sources, context, output).write();
}

core::IndexLists inputIndices(const core::PointSet& points, const core::IndexLists& lists,
                              const core::Context& context) {
  core::CancelCheck check(context);
  core::IndexLists result;
  result.begin.reserve(lists.begin.size());
  result.items.reserve(lists.items.size());
  for (Index list = 0; list < lists.count(); ++list) {
    check();
    for (Index i = 0; i < lists.size(list); ++i) {
      const Index point = lists.data(list)[i];
      const Index* inputs = points.duplicates_of.data(point);
      result.items.insert(result.items.end(), inputs, inputs + points.duplicates_of.size(point));
    }
    if (result.items.size() > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
      throw Failure(StatusCode::IndexOverflow, "the clusters have more members than 32-bit indices can name");
    }
    result.begin.push_back(static_cast<Index>(result.items.size()));
  }
  return result;
}

std::vector<pcl::Vertices> toPolygons(const std::vector<core::Triangle>& triangles,
                                      const core::Context& context) {
  core::CancelCheck check(context);
  std::vector<pcl::Vertices> polygons(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    check();
    polygons[i].vertices.assign(triangles[i].begin(), triangles[i].end());
  }
  return polygons;
}

void makeLevelCloud(const core::Reconstruction& reconstruction, Index level, const pcl::PCLPointCloud2& input,
                    pcl::PCLPointCloud2& output, const core::Context& context) {
  const core::RefinedMesh& mesh = reconstruction.mesh;
  const core::PointSet& points = reconstruction.points;
  checkLevel(mesh, level);
  const auto count = static_cast<std::size_t>(mesh.level_vertices[level]);
  VertexData data;
  VertexSources sources;
  data.stored_as = points.stored_as;
  data.normal.assign(mesh.normal.begin(), mesh.normal.begin() + static_cast<std::ptrdiff_t>(count));
  context.checkCancelled();
  data.curvature = levelCurvature(reconstruction, count);
  data.position.reserve(count);
  sources.nearest.reserve(count);
  core::CancelCheck check(context);
  for (std::size_t v = 0; v < count; ++v) {
    check();
    data.position.push_back(points.world(mesh.position[v]));
    sources.nearest.push_back(points.source[mesh.nearest[v]]);
  }
  sources.members = inputIndices(points, reconstruction.clusters, context);
  sources.parents = mesh.parents;
  makeVertexCloud(input, data, sources, output, context);
}

void makePolygonMesh(const core::Reconstruction& reconstruction, Index level,
                     const pcl::PCLPointCloud2& input, pcl::PolygonMesh& output,
                     const core::Context& context) {
  checkLevel(reconstruction.mesh, level);
  output.header = input.header;
  makeLevelCloud(reconstruction, level, input, output.cloud, context);
  output.polygons = toPolygons(reconstruction.mesh.level_triangles[level], context);
}

void makePolygonMesh(const core::RefinedMesh& mesh, Index level, const pcl::PCLPointCloud2& finest,
                     pcl::PolygonMesh& output, const core::Context& context) {
  checkLevel(mesh, level);
  const std::size_t bytes = static_cast<std::size_t>(mesh.level_vertices[level]) * finest.point_step;
  std::vector<pcl::Vertices> polygons = toPolygons(mesh.level_triangles[level], context);
  context.checkCancelled();
  output.header = finest.header;
  output.cloud = pcl::PCLPointCloud2();
  output.cloud.header = finest.header;
  output.cloud.fields = finest.fields;
  output.cloud.width = static_cast<pcl::uindex_t>(mesh.level_vertices[level]);
  output.cloud.height = 1;
  output.cloud.point_step = finest.point_step;
  output.cloud.row_step = static_cast<pcl::uindex_t>(bytes);
  output.cloud.is_dense = finest.is_dense;
  output.cloud.data.assign(finest.data.begin(), finest.data.begin() + static_cast<std::ptrdiff_t>(bytes));
  output.polygons.swap(polygons);
}

}  // namespace mlsmesh

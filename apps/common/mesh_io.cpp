// SPDX-License-Identifier: BSD-3-Clause
#include "common/mesh_io.h"

#include "common/app_error.h"
#include "common/atomic_output.h"
#include "common/cloud_columns.h"
#include "common/file_bytes.h"
#include "common/vtk_io.h"

#include <array>
#include <charconv>
#include <cstring>
#include <fstream>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

using Type = pcl::PCLPointField::PointFieldTypes;

constexpr std::size_t kBlock = 1 << 20;

/// A file written in blocks.
class Sink {
 public:
  explicit Sink(const fs::path& file) : stream_(file, std::ios::binary | std::ios::trunc) {}

  void text(const std::string& characters) { bytes(characters.data(), characters.size()); }
  void bytes(const void* data, std::size_t size) {
    const char* first = static_cast<const char*>(data);
    buffer_.insert(buffer_.end(), first, first + size);
    if (buffer_.size() >= kBlock) flush();
  }
  /// Shortest digits that read back as the same value, of the type it is stored in.
  template <class T>
  void number(T value) {
    char digits[32];
    const std::to_chars_result end = std::to_chars(digits, digits + sizeof digits, value);
    bytes(digits, static_cast<std::size_t>(end.ptr - digits));
  }
  /// False if anything could not be written.
  bool close() {
    flush();
    stream_.close();
    return static_cast<bool>(stream_);
  }

 private:
  void flush() {
    stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::ofstream stream_;
  std::vector<char> buffer_;
};

/// PLY has no 64-bit integers: they become doubles.
bool isWideInteger(const FieldSlot& slot) {
  return slot.datatype == Type::INT64 || slot.datatype == Type::UINT64;
}

const char* plyType(std::uint8_t type) {
  switch (type) {
    case Type::BOOL:
    case Type::UINT8:
      return "uchar";
    case Type::INT8:
      return "char";
    case Type::INT16:
      return "short";
    case Type::UINT16:
      return "ushort";
    case Type::INT32:
      return "int";
    case Type::UINT32:
      return "uint";
    case Type::FLOAT32:
      return "float";
    default:
      return "double";
  }
}

std::string plyHeader(const pcl::PolygonMesh& mesh, const std::vector<FieldSlot>& slots) {
  std::string header = "ply\nformat binary_little_endian 1.0\ncomment mlsmesh\n";
  header += "element vertex " + std::to_string(pointCount(mesh.cloud)) + "\n";
  for (const FieldSlot& slot : slots)
    header += std::string("property ") + plyType(slot.datatype) + " " + slot.name + "\n";
  header += "element face " + std::to_string(mesh.polygons.size()) + "\n";
  return header + "property list uchar int vertex_indices\nend_header\n";
}

void putSlot(const pcl::PCLPointCloud2& cloud, const FieldSlot& slot, std::size_t point, Sink& sink) {
  if (isWideInteger(slot)) {
    const double value = slotValue(cloud, slot, point);
    sink.bytes(&value, sizeof value);
  } else {
    sink.bytes(&cloud.data[point * cloud.point_step + slot.offset], sizeOfType(slot.datatype));
  }
}

/// By hand, because PCL's binary writer of meshes takes float32 coordinates only and drops all fields but
/// colour and normals.
bool writePly(const fs::path& file, const pcl::PolygonMesh& mesh) {
  const std::vector<FieldSlot> slots = fieldSlots(mesh.cloud);
  Sink sink(file);
  sink.text(plyHeader(mesh, slots));
  for (std::size_t i = 0; i < pointCount(mesh.cloud); ++i) {
    for (const FieldSlot& slot : slots) putSlot(mesh.cloud, slot, i, sink);
  }
  for (const pcl::Vertices& polygon : mesh.polygons) {
    const auto corners = static_cast<std::uint8_t>(polygon.vertices.size());
    sink.bytes(&corners, 1);
    for (const auto vertex : polygon.vertices) {
      const auto index = static_cast<std::int32_t>(vertex);
      sink.bytes(&index, sizeof index);
    }
  }
  return sink.close();
}

using SlotTriple = std::array<const FieldSlot*, 3>;

bool isWhole(const SlotTriple& triple) {
  return triple[0] && triple[1] && triple[2];
}

void putNumbers(const pcl::PCLPointCloud2& cloud, const SlotTriple& slots, std::size_t point, Sink& sink) {
  for (const FieldSlot* slot : slots) {
    sink.text(" ");
    const double value = slotValue(cloud, *slot, point);
    if (slot->datatype == Type::FLOAT32) {
      sink.number(static_cast<float>(value));
    } else {
      sink.number(value);
    }
  }
}

/// Colours in OBJ are 0 .. 1; four digits tell 256 steps apart.
void putColor(const pcl::PCLPointCloud2& cloud, const SlotTriple& slots, std::size_t point, Sink& sink) {
  for (const FieldSlot* slot : slots) {
    char text[16];
    std::snprintf(text, sizeof text, " %.4f", slotValue(cloud, *slot, point) / 255);
    sink.text(text);
  }
}

/// By hand, because PCL's writer takes float32 coordinates only and drops the colour.
bool writeObj(const fs::path& file, const pcl::PolygonMesh& mesh) {
  const std::vector<FieldSlot> slots = fieldSlots(mesh.cloud);
  const SlotTriple xyz = {findSlot(slots, "x"), findSlot(slots, "y"), findSlot(slots, "z")};
  const SlotTriple normals = {findSlot(slots, "nx"), findSlot(slots, "ny"), findSlot(slots, "nz")};
  const SlotTriple colors = {findSlot(slots, "red"), findSlot(slots, "green"), findSlot(slots, "blue")};
  Sink sink(file);
  sink.text("# mlsmesh\n");
  for (std::size_t i = 0; i < pointCount(mesh.cloud); ++i) {
    sink.text("v");
    putNumbers(mesh.cloud, xyz, i, sink);
    if (isWhole(colors)) putColor(mesh.cloud, colors, i, sink);
    sink.text("\n");
  }
  for (std::size_t i = 0; isWhole(normals) && i < pointCount(mesh.cloud); ++i) {
    sink.text("vn");
    putNumbers(mesh.cloud, normals, i, sink);
    sink.text("\n");
  }
  for (const pcl::Vertices& polygon : mesh.polygons) {
    sink.text("f");
    for (const auto vertex : polygon.vertices) {
      const std::string number = std::to_string(vertex + 1);
      sink.text(" " + number + (isWhole(normals) ? "//" + number : ""));
    }
    sink.text("\n");
  }
  return sink.close();
}

struct Format {
  const char* extension;
  bool (*write)(const fs::path& file, const pcl::PolygonMesh& mesh);
  bool keeps_color;
  bool keeps_doubles;
};

constexpr std::array<Format, 5> kFormats = {{{"ply", writePly, true, true},
                                             {"obj", writeObj, true, true},
                                             {"stl", writeStl, false, false},
                                             {"vtk", writeVtk, true, true},
                                             {"vtp", writeVtp, true, true}}};

const Format& formatOf(const fs::path& file) {
  const std::string extension = extensionOf(file);
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw AppError(kExitUsage, file.string() + ": cannot write meshes of type '" + extension +
                                 "'; use one of " + writableMeshFormats());
}

}  // namespace

std::string writableMeshFormats() {
  std::string list;
  for (const Format& format : kFormats) list += std::string(list.empty() ? "" : ", ") + format.extension;
  return list;
}

void checkWritableMeshFormat(const fs::path& file) {
  formatOf(file);
}

void writeMesh(const fs::path& file, const fs::path& target, const pcl::PolygonMesh& mesh) {
  if (!formatOf(target).write(file, mesh)) throw notWritten(file, target);
}

std::vector<std::string> lossesOf(const fs::path& target, const pcl::PCLPointCloud2& vertices) {
  const Format& format = formatOf(target);
  std::vector<std::string> losses;
  if (!format.keeps_color && (findField(vertices, "rgb") || findField(vertices, "rgba"))) {
    losses.push_back(target.string() + ": this format has no colour; write .ply to keep it");
  }
  if (!format.keeps_doubles && hasDoubleCoordinates(vertices)) {
    losses.push_back(target.string() +
                     ": this format rounds the double coordinates to float; write .ply to keep them");
  }
  return losses;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "common/vtk_io.h"

#include "common/app_error.h"
#include "common/cloud_columns.h"
#include "common/file_bytes.h"
#include "common/point_arrays.h"
#include "common/vtk_errors.h"
#include "common/vtk_legacy.h"
#include "common/vtp_check.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataWriter.h>
#include <vtkSTLWriter.h>
#include <vtkSmartPointer.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <array>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

using Type = pcl::PCLPointField::PointFieldTypes;

std::uint8_t typeOf(int vtk_type) {
  switch (vtk_type) {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
      return Type::INT8;
    case VTK_UNSIGNED_CHAR:
      return Type::UINT8;
    case VTK_SHORT:
      return Type::INT16;
    case VTK_UNSIGNED_SHORT:
      return Type::UINT16;
    case VTK_INT:
      return Type::INT32;
    case VTK_UNSIGNED_INT:
      return Type::UINT32;
    case VTK_FLOAT:
      return Type::FLOAT32;
    default:
      return Type::FLOAT64;
  }
}

int vtkTypeOf(std::uint8_t type) {
  switch (type) {
    case Type::BOOL:
    case Type::UINT8:
      return VTK_UNSIGNED_CHAR;
    case Type::INT8:
      return VTK_SIGNED_CHAR;
    case Type::INT16:
      return VTK_SHORT;
    case Type::UINT16:
      return VTK_UNSIGNED_SHORT;
    case Type::INT32:
      return VTK_INT;
    case Type::UINT32:
      return VTK_UNSIGNED_INT;
    case Type::FLOAT32:
      return VTK_FLOAT;
    default:
      return VTK_DOUBLE;
  }
}

/// All values of an array, tuple by tuple.
std::vector<double> valuesOf(vtkDataArray& array) {
  const vtkIdType tuples = array.GetNumberOfTuples();
  const int components = array.GetNumberOfComponents();
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(tuples) * static_cast<std::size_t>(components));
  for (vtkIdType i = 0; i < tuples; ++i)
    for (int c = 0; c < components; ++c) values.push_back(array.GetComponent(i, c));
  return values;
}

void makeCloudOf(vtkPolyData& set, pcl::PCLPointCloud2& cloud) {
  vtkDataArray& points = *set.GetPoints()->GetData();
  const std::uint8_t type = typeOf(points.GetDataType()) == Type::FLOAT64 ? Type::FLOAT64 : Type::FLOAT32;
  std::vector<CloudColumn> columns;
  for (int axis = 0; axis < 3; ++axis) {
    columns.push_back({std::string(1, "xyz"[axis]), type, {}});
    for (vtkIdType i = 0; i < points.GetNumberOfTuples(); ++i)
      columns.back().values.push_back(points.GetComponent(i, axis));
  }
  vtkPointData& data = *set.GetPointData();
  for (int i = 0; i < data.GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetArray(i);
    if (array == nullptr || array->GetNumberOfTuples() != points.GetNumberOfTuples()) continue;
    const std::string name = array->GetName() ? array->GetName() : "scalars";
    const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
    appendPointArray({name, typeOf(array->GetDataType()), components, array == data.GetNormals()},
                     valuesOf(*array), columns);
  }
  makeCloud(columns, cloud);
}

/// Runs a reader whose input is set.
template <class Reader>
void readWithVtk(Reader& reader, const fs::path& file, pcl::PCLPointCloud2& cloud) {
  const auto counter = countVtkErrors();
  reader.Update();
  if (counter->errors() > 0 || reader.GetErrorCode() != vtkErrorCode::NoError) {
    throw damagedFile(file.string(), "VTK");
  }
  vtkPolyData* set = reader.GetOutput();
  if (set == nullptr || set->GetNumberOfPoints() == 0) {
    throw fileError(file.string(), "holds no points; give a file with points");
  }
  makeCloudOf(*set, cloud);
}

/// Slots of one cloud as an array of as many components.
template <std::size_t N>
vtkSmartPointer<vtkDataArray> makeArray(const pcl::PCLPointCloud2& cloud, const char* name,
                                        const std::array<const FieldSlot*, N>& slots) {
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(vtkTypeOf(slots[0]->datatype)));
  array->SetName(name);
  array->SetNumberOfComponents(static_cast<int>(N));
  array->SetNumberOfTuples(static_cast<vtkIdType>(pointCount(cloud)));
  for (std::size_t i = 0; i < pointCount(cloud); ++i) {
    for (std::size_t c = 0; c < N; ++c) {
      array->SetComponent(static_cast<vtkIdType>(i), static_cast<int>(c), slotValue(cloud, *slots[c], i));
    }
  }
  return array;
}

using SlotTriple = std::array<const FieldSlot*, 3>;

SlotTriple findSlots(const std::vector<FieldSlot>& slots, const char* a, const char* b, const char* c) {
  return {findSlot(slots, a), findSlot(slots, b), findSlot(slots, c)};
}

bool isWhole(const SlotTriple& triple) {
  return triple[0] && triple[1] && triple[2];
}

bool belongsTo(const SlotTriple& triple, const FieldSlot& slot) {
  return isWhole(triple) && (&slot == triple[0] || &slot == triple[1] || &slot == triple[2]);
}

void addPointData(const pcl::PCLPointCloud2& cloud, const std::vector<FieldSlot>& slots, vtkPointData& data) {
  const SlotTriple xyz = findSlots(slots, "x", "y", "z");
  const SlotTriple normals = findSlots(slots, "nx", "ny", "nz");
  const SlotTriple colors = findSlots(slots, "red", "green", "blue");
  const FieldSlot* alpha = findSlot(slots, "alpha");
  for (const FieldSlot& slot : slots) {
    const bool in_colors = belongsTo(colors, slot) || (isWhole(colors) && &slot == alpha);
    if (belongsTo(xyz, slot) || belongsTo(normals, slot) || in_colors) continue;
    data.AddArray(makeArray<1>(cloud, slot.name.c_str(), {&slot}));
  }
  if (isWhole(normals)) data.SetNormals(makeArray(cloud, "Normals", normals));
  if (!isWhole(colors)) return;
  if (alpha) {
    data.SetScalars(makeArray<4>(cloud, "Colors", {colors[0], colors[1], colors[2], alpha}));
  } else {
    data.SetScalars(makeArray(cloud, "Colors", colors));
  }
}

vtkSmartPointer<vtkPolyData> makePolyData(const pcl::PolygonMesh& mesh, bool with_point_data) {
  const std::vector<FieldSlot> slots = fieldSlots(mesh.cloud);
  auto poly_data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(makeArray(mesh.cloud, "Points", findSlots(slots, "x", "y", "z")));
  poly_data->SetPoints(points);
  vtkNew<vtkCellArray> polygons;
  for (const pcl::Vertices& polygon : mesh.polygons) {
    polygons->InsertNextCell(static_cast<int>(polygon.vertices.size()));
    for (const auto vertex : polygon.vertices) polygons->InsertCellPoint(static_cast<vtkIdType>(vertex));
  }
  poly_data->SetPolys(polygons);
  if (with_point_data) addPointData(mesh.cloud, slots, *poly_data->GetPointData());
  return poly_data;
}

template <class Writer>
bool writeWithVtk(Writer& writer, const fs::path& file, const vtkSmartPointer<vtkPolyData>& poly_data) {
  const auto counter = countVtkErrors();
  writer.SetFileName(file.c_str());
  writer.SetInputData(poly_data);
  const bool written = writer.Write() != 0;
  return written && counter->errors() == 0 && writer.GetErrorCode() == vtkErrorCode::NoError;
}

}  // namespace

void readVtk(const fs::path& file, pcl::PCLPointCloud2& cloud) {
  makeCloud(cloudOfLegacyVtk(readBytes(file), file.string()), cloud);
}

void readVtp(const fs::path& file, pcl::PCLPointCloud2& cloud) {
  checkVtp(file);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  readWithVtk(*reader.GetPointer(), file, cloud);
}

bool writeVtk(const fs::path& file, const pcl::PolygonMesh& mesh) {
  vtkNew<vtkPolyDataWriter> writer;
  writer->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
  writer->SetFileTypeToBinary();  // its text keeps six digits only
  return writeWithVtk(*writer.GetPointer(), file, makePolyData(mesh, true));
}

bool writeVtp(const fs::path& file, const pcl::PolygonMesh& mesh) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  return writeWithVtk(*writer.GetPointer(), file, makePolyData(mesh, true));
}

bool writeStl(const fs::path& file, const pcl::PolygonMesh& mesh) {
  vtkNew<vtkSTLWriter> writer;
  writer->SetFileTypeToBinary();
  return writeWithVtk(*writer.GetPointer(), file, makePolyData(mesh, false));
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "common/vtk_mesh.h"

#include "common/app_error.h"
#include "common/file_bytes.h"
#include "common/vtk_errors.h"
#include "common/vtk_legacy.h"
#include "common/vtp_check.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkErrorCode.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <string>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

/// Where every cell begins must not fall, nor be beyond the end of the list of corners.
bool isSound(vtkCellArray& cells) {
  vtkDataArray& begin = *cells.GetOffsetsArray();
  const auto corners = static_cast<double>(cells.GetConnectivityArray()->GetNumberOfTuples());
  double last = 0;
  for (vtkIdType i = 0; i < begin.GetNumberOfTuples(); ++i) {
    const double place = begin.GetComponent(i, 0);
    if (place < last || place > corners) return false;
    last = place;
  }
  return true;
}

void appendPolygons(vtkCellArray& cells, PolygonSoup& soup) {
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) {
    cells.GetCellAtId(cell, ids);
    soup.corners.insert(soup.corners.end(), ids->begin(), ids->end());
    soup.endPolygon();
  }
}

/// Every other triangle of a strip is listed the other way round.
void appendStrips(vtkCellArray& cells, PolygonSoup& soup) {
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < cells.GetNumberOfCells(); ++cell) {
    cells.GetCellAtId(cell, ids);
    for (vtkIdType i = 2; i < ids->GetNumberOfIds(); ++i) {
      const vtkIdType odd = i % 2;
      for (const vtkIdType place : {i - 2 + odd, i - 1 - odd, i}) soup.corners.push_back(ids->GetId(place));
      soup.endPolygon();
    }
  }
}

void appendVertices(vtkPoints& points, PolygonSoup& soup) {
  soup.vertices.resize(static_cast<std::size_t>(points.GetNumberOfPoints()));
  for (std::size_t i = 0; i < soup.vertices.size(); ++i)
    points.GetPoint(static_cast<vtkIdType>(i), soup.vertices[i].data());
}

/// Runs a reader whose input is set.
template <class Reader>
PolygonSoup readWithVtk(Reader& reader, const fs::path& file, const std::string& format) {
  const auto counter = countVtkErrors();
  reader.Update();
  if (counter->errors() > 0 || reader.GetErrorCode() != vtkErrorCode::NoError)
    throw damagedFile(file.string(), format);
  vtkPolyData* const data = reader.GetOutput();
  if (data == nullptr || data->GetNumberOfPoints() == 0)
    throw fileError(file.string(), "holds no points; give a file with a mesh");
  if (!isSound(*data->GetPolys()) || !isSound(*data->GetStrips())) throw damagedFile(file.string(), format);
  PolygonSoup soup;
  appendVertices(*data->GetPoints(), soup);
  appendPolygons(*data->GetPolys(), soup);
  appendStrips(*data->GetStrips(), soup);
  return soup;
}

}  // namespace

PolygonSoup readVtkMesh(const fs::path& file) {
  return meshOfLegacyVtk(readBytes(file), file.string());
}

PolygonSoup readVtpMesh(const fs::path& file) {
  checkVtp(file);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  return readWithVtk(*reader.GetPointer(), file, "VTP");
}

}  // namespace mlsmesh::apps

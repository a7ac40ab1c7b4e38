// SPDX-License-Identifier: BSD-3-Clause
#include "common/mesh_reader.h"

#include "common/app_error.h"
#include "common/file_bytes.h"
#include "common/obj_mesh.h"
#include "common/ply_mesh.h"
#include "common/stl_mesh.h"
#include "common/vtk_mesh.h"
#include "mlsmesh/mesh_welding.h"

#include <algorithm>
#include <array>
#include <limits>
#include <new>

namespace mlsmesh::apps {

namespace fs = std::filesystem;

namespace {

struct Format {
  const char* extension;
  PolygonSoup (*read)(const fs::path& file);
  bool shares_corners;
};

constexpr std::array<Format, 5> kFormats = {{{"ply", readPlyMesh, true},
                                             {"obj", readObjMesh, true},
                                             {"stl", readStlMesh, false},
                                             {"vtk", readVtkMesh, true},
                                             {"vtp", readVtpMesh, true}}};

const Format& formatOf(const fs::path& file) {
  const std::string extension = extensionOf(file);
  for (const Format& format : kFormats) {
    if (extension == format.extension) return format;
  }
  throw AppError(kExitUsage, file.string() + ": cannot read meshes of type '" + extension + "'; use one of " +
                                 readableMeshFormats());
}

/// Counts of vertices, and of triangles that polygons are cut into, must fit our indices.
void checkCounts(const fs::path& file, const PolygonSoup& soup) {
  constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<core::Index>::max());
  if (soup.vertices.size() <= kMost && soup.corners.size() <= kMost) return;
  throw fileError(file.string(),
                  "has more vertices or faces than 32-bit indices can name; simplify it first");
}

bool isPolygon(const std::int64_t* first, const std::int64_t* last, const std::vector<char>& usable) {
  return last - first >= 3 && std::all_of(first, last, [&](std::int64_t corner) {
           return corner >= 0 && corner < static_cast<std::int64_t>(usable.size()) &&
                  usable[static_cast<std::size_t>(corner)] != 0;
         });
}

void cutIntoTriangles(const PolygonSoup& soup, const std::vector<char>& usable, TriangleFile& mesh) {
  const std::int64_t* first = soup.corners.data();
  for (const std::size_t end : soup.ends) {
    const std::int64_t* const last = soup.corners.data() + end;
    if (isPolygon(first, last, usable)) {
      mesh.polygons += last - first > 3;
      for (const std::int64_t* corner = first + 2; corner < last; ++corner) {
        mesh.triangles.push_back({static_cast<core::Index>(*first), static_cast<core::Index>(corner[-1]),
                                  static_cast<core::Index>(*corner)});
      }
    } else {
      ++mesh.dropped_faces;
    }
    first = last;
  }
}

TriangleFile triangulated(PolygonSoup soup) {
  TriangleFile mesh;
  std::vector<char> usable(soup.vertices.size(), 1);
  for (std::size_t v = 0; v < usable.size(); ++v) {
    if (soup.vertices[v].allFinite()) continue;
    usable[v] = 0;
    soup.vertices[v].setZero();
    ++mesh.non_finite_vertices;
  }
  mesh.triangles.reserve(soup.polygonCount());
  cutIntoTriangles(soup, usable, mesh);
  mesh.vertices = std::move(soup.vertices);
  return mesh;
}

}  // namespace

std::string readableMeshFormats() {
  std::string list;
  for (const Format& format : kFormats) list += std::string(list.empty() ? "" : ", ") + format.extension;
  return list;
}

void checkReadableMeshFormat(const fs::path& file) {
  formatOf(file);
}

TriangleFile readTriangles(const fs::path& file) {
  const Format& format = formatOf(file);
  checkReadable(file);
  try {
    PolygonSoup soup = format.read(file);
    checkCounts(file, soup);
    TriangleFile mesh = triangulated(std::move(soup));
    if (!format.shares_corners) mesh.welded_vertices = weldVertices(mesh.vertices, mesh.triangles);
    return mesh;
  } catch (const std::bad_alloc&) {
    throw fileError(file.string(),
                    "does not fit into memory; use a smaller mesh, or check the sizes in its header");
  }
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
// Whatever a file holds, it is read as triangles of finite vertices, or refused by an AppError.
#include "common/app_error.h"
#include "common/mesh_reader.h"
#include "input_file.h"

#include <cstdlib>

namespace {

void checkMesh(const mlsmesh::apps::TriangleFile& mesh) {
  for (const mlsmesh::core::Vec3& vertex : mesh.vertices)
    if (!vertex.allFinite()) std::abort();
  for (const mlsmesh::core::Triangle& triangle : mesh.triangles)
    for (const mlsmesh::core::Index corner : triangle)
      if (corner < 0 || static_cast<std::size_t>(corner) >= mesh.vertices.size()) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    checkMesh(mlsmesh::apps::readTriangles(mlsmesh::fuzz::inputFile(data, size, MLSMESH_EXTENSION)));
  } catch (const mlsmesh::apps::AppError&) {
    return 0;
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mlsmesh {

enum class StatusCode {
  Ok,
  NoInput,           ///< no cloud was set
  EmptyInput,        ///< the cloud holds no point
  TooFewPoints,      ///< fewer than 3 distinct finite points
  DegenerateInput,   ///< all points equal or on a line
  NoTriangles,       ///< nothing could be triangulated
  NoMesh,            ///< refinement without a mesh
  InvalidMesh,       ///< not triangles, index out of range, not manifold, or misoriented
  InvalidParameter,  ///< a parameter is out of its range
  InvalidIndices,    ///< setIndices names points the cloud does not have
  IndexOverflow,     ///< more items than 32-bit indices can name
  OutOfMemory,
  Cancelled,
  Internal,  ///< a fault of this library
};

/// Stable name of a code, e.g. "TooFewPoints".
const char* name(StatusCode code);

/// Outcome of a verb: a code and a text that names the culprit and the remedy (empty when Ok). Warnings do not make it fail.
struct Status {
  StatusCode code = StatusCode::Ok;
  std::string message;
  std::vector<std::string> warnings;

  bool ok() const { return code == StatusCode::Ok; }
};

}  // namespace mlsmesh

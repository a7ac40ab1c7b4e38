// SPDX-License-Identifier: BSD-3-Clause
#include "mlsmesh/status.h"

namespace mlsmesh {

const char* name(StatusCode code) {
  switch (code) {
    case StatusCode::Ok:
      return "Ok";
    case StatusCode::NoInput:
      return "NoInput";
    case StatusCode::EmptyInput:
      return "EmptyInput";
    case StatusCode::TooFewPoints:
      return "TooFewPoints";
    case StatusCode::DegenerateInput:
      return "DegenerateInput";
    case StatusCode::NoTriangles:
      return "NoTriangles";
    case StatusCode::NoMesh:
      return "NoMesh";
    case StatusCode::InvalidMesh:
      return "InvalidMesh";
    case StatusCode::InvalidParameter:
      return "InvalidParameter";
    case StatusCode::InvalidIndices:
      return "InvalidIndices";
    case StatusCode::IndexOverflow:
      return "IndexOverflow";
    case StatusCode::OutOfMemory:
      return "OutOfMemory";
    case StatusCode::Cancelled:
      return "Cancelled";
    case StatusCode::Internal:
      return "Internal";
  }
  return "Unknown";
}

}  // namespace mlsmesh

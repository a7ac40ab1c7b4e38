// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "mlsmesh/core/multiresolution.h"
#include "mlsmesh/status.h"

// What every reconstruction promises, asked of its result alone.
namespace mlsmesh::test {

/// The first promise that the result breaks, with the level that breaks it, or nothing: every level an
/// oriented 2-manifold with border (core::HalfEdgeMesh::validate, and counted anew by meshTopology), no
/// degenerate or duplicate face, no isolated vertex, finite positions as stored, unit normals, the same Euler
/// number and border loops as level 0, reports that tell the truth.
std::string faultOf(const core::Reconstruction& result);

/// The same for triangles alone, of which not every vertex need be used.
std::string faultOf(const std::vector<core::Vec3>& vertices, const std::vector<core::Triangle>& triangles);

/// How a cloud fared.
struct Outcome {
  StatusCode code = StatusCode::Ok;
  std::string fault;                    ///< of the result, or of the refusal; none if all is as promised
  core::Index triangles = 0;            ///< of the finest level
  std::int64_t self_intersections = 0;  ///< most of a level
  double seconds = 0;                   ///< of the process, all threads
};

/// Reconstructs the cloud and looks at the result. A refusal is no fault if the cloud may deserve it:
/// TooFewPoints, DegenerateInput or NoTriangles; EmptyInput of one without a point.
Outcome outcomeOf(const std::vector<core::Vec3>& world, core::StoredAs stored_as,
                  const MultiresolutionParameters& parameters, core::Context& context);
Outcome outcomeOf(const std::vector<core::Vec3>& world, core::StoredAs stored_as = core::StoredAs::Float,
                  const MultiresolutionParameters& parameters = {});

}  // namespace mlsmesh::test

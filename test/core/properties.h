// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "clouds/random_clouds.h"
#include "clouds/soundness.h"
#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/multiresolution.h"
#include "surfaces.h"

// What the property tests draw, and how they compare. RapidCheck takes seed and number of cases from the
// environment variable RC_PARAMS, e.g. "seed=7 max_success=2000"; properties_main.cpp sets it where it is not
// set, and RapidCheck prints it.
namespace mlsmesh::test {

inline core::Reconstruction meshOf(const Points& world, core::StoredAs stored_as = core::StoredAs::Double,
                                   const MultiresolutionParameters& parameters = {}) {
  core::Context context = withThreads(1);
  return reconstruct(makePointSet(world, stored_as, nullptr, context), nullptr, parameters, context);
}

/// An even scan of a known surface, its points so many thousandths apart: its topology must come out whatever
/// is done to it that changes none.
inline Points drawSurface(int least = 60, int most = 120) {
  const auto shape = *rc::gen::element<std::string>("sphere", "torus", "saddle", "cylinder").as("shape");
  const double distance = *rc::gen::inRange(least, most).as("thousandths between the points") * 1e-3;
  const auto seed = *rc::gen::inRange<std::uint64_t>(1, 1000).as("seed of the scan");
  return evenSample(shape, distance, seed);
}

/// A cloud of any kind, with everything that may be done to it.
inline RandomCloud drawAnyCloud(std::size_t most) {
  RandomCloud cloud = drawCloud(*rc::gen::arbitrary<std::uint64_t>().as("seed of the cloud"), most);
  RC_LOG() << cloud.description << '\n';
  return cloud;
}

/// A rotation, evenly distributed (Shoemake 1992: a random unit quaternion).
inline Eigen::Matrix3d drawRotation() {
  shapes::Random random(*rc::gen::arbitrary<std::uint64_t>().as("seed of the rotation"));
  const core::Vec3 xyz = random.normalVector();
  return Eigen::Quaterniond(random.normal(), xyz.x(), xyz.y(), xyz.z()).normalized().toRotationMatrix();
}

inline void sameBits(const core::Reconstruction& a, const core::Reconstruction& b) {
  RC_ASSERT(a.mesh.position == b.mesh.position);
  RC_ASSERT(a.mesh.normal == b.mesh.normal);
  RC_ASSERT(a.mesh.kind == b.mesh.kind);
  RC_ASSERT(a.mesh.level_vertices == b.mesh.level_vertices);
  RC_ASSERT(a.mesh.level_triangles == b.mesh.level_triangles);
}

/// The status that a cloud ends with.
template <typename Work>
StatusCode codeOf(const Work& work) {
  return core::guarded(work).code;
}

}  // namespace mlsmesh::test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mlsmesh/core/point_set.h"
#include "mlsmesh/parameters.h"
#include "shapes/random.h"

// Clouds of all kinds, those that are no surface among them.
namespace mlsmesh::test {

/// One kind of cloud: about `count` points, of the order of 1 unless the kind is about other sizes.
struct CloudKind {
  const char* name;
  std::vector<core::Vec3> (*draw)(std::size_t count, shapes::Random& random);
};

/// Surfaces with noise, with holes, that cross or touch; volumes, dust, curves, lattices, clumps, duplicates,
/// arbitrary bits, ...
const std::vector<CloudKind>& cloudKinds();

/// The kind of that name. Throws std::out_of_range.
const CloudKind& cloudKind(const std::string& name);

/// A cloud of a kind, perhaps turned, stretched, scaled and far from the origin, and what to do with it.
struct RandomCloud {
  const char* kind = nullptr;
  std::vector<core::Vec3> points;
  core::StoredAs stored_as = core::StoredAs::Float;
  MultiresolutionParameters parameters;
  std::string description;  ///< what was drawn, in short
};

/// The same seed gives the same cloud. Of 3 points to `most`, small ones more often.
RandomCloud drawCloud(std::uint64_t seed, std::size_t most);

}  // namespace mlsmesh::test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/core/context.h"
#include "mlsmesh/core/types.h"

namespace mlsmesh::core {

/// Type in which the vertices will be stored; positions are rounded to it before any topology is decided.
enum class StoredAs { Float, Double };

/// The distinct finite points of a cloud, relative to a local origin, in canonical order (Morton key, ties by
/// x, y, z), which depends on the set of points alone and not on their order in the input.
struct PointSet {
  std::vector<Vec3> position;  ///< relative to origin, pairwise distinct, -0 written as 0
  Vec3 origin = Vec3::Zero();  ///< world = position + origin
  StoredAs stored_as = StoredAs::Float;
  std::vector<Index> source;  ///< input index of each point (the lowest of its duplicates)
  IndexLists duplicates_of;   ///< all input indices of each point, ascending (one, but for duplicates)
  Index non_finite = 0;  ///< input points dropped because a coordinate was NaN or infinite (as stored_as)
  Index duplicates = 0;  ///< input points dropped because another has the same position

  Index size() const { return static_cast<Index>(position.size()); }
  /// `local` as it will read once stored in world coordinates of type stored_as; what lies beyond the largest
  /// float is stored as that, and a double coordinate below 1e-70 in size as 0.
  Vec3 stored(const Vec3& local) const;
  /// World coordinates of a local position, before they are rounded to stored_as.
  Vec3 world(const Vec3& local) const { return local + origin; }
};

/// Builds a point set from `world` coordinates. With `indices` only those of its entries take part (repeats
/// count as duplicates). Throws Failure: EmptyInput, InvalidIndices, IndexOverflow (more than 2^31 - 1),
/// TooFewPoints (fewer than 3 distinct finite), DegenerateInput (all on a line within 1e-9 of the extent or
/// two units in the last place of the stored coordinates; or an extent outside 1e-50 .. 1e50), Cancelled. O(n
/// log n).
PointSet makePointSet(std::vector<Vec3> world, StoredAs stored_as, const std::vector<Index>* indices,
                      Context& context);

/// Takes the listed points (ascending) out of the set; the order of the others stays.
void removePoints(const std::vector<Index>& removed, PointSet& points);

}  // namespace mlsmesh::core

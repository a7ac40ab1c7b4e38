// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/palette.h"

namespace mlsmesh::apps {

/// What is marked on a mesh; each also differs from the others in width or shape.
struct MarkColors {
  static constexpr Rgb kFront{165, 173, 184};
  static constexpr Rgb kBack{92, 100, 114};
  static constexpr Rgb kBorder{213, 94, 0};
  static constexpr Rgb kMisoriented{0, 84, 166};
  static constexpr Rgb kNonManifold{0, 0, 0};
  static constexpr Rgb kIntersecting{204, 121, 167};
};

/// Spacings at the end of the scales of the two maps of distances; beyond it the last colour goes on.
inline constexpr double kCloudToMeshEnd = 2;
inline constexpr double kMeshToCloudEnd = 5;

}  // namespace mlsmesh::apps

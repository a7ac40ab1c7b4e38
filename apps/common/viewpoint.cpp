// SPDX-License-Identifier: BSD-3-Clause
#include "common/viewpoint.h"

#include "common/command_line.h"

#include <algorithm>
#include <array>

namespace mlsmesh::apps {
namespace {

struct Named {
  const char* name;
  std::array<double, 3> from;
  std::array<double, 3> up;
};

/// In axes right, up, towards the viewer.
constexpr std::array<Named, 7> kViews{{{"front", {0, 0, 1}, {0, 1, 0}},
                                       {"back", {0, 0, -1}, {0, 1, 0}},
                                       {"left", {-1, 0, 0}, {0, 1, 0}},
                                       {"right", {1, 0, 0}, {0, 1, 0}},
                                       {"top", {0, 1, 0}, {0, 0, -1}},
                                       {"bottom", {0, -1, 0}, {0, 0, 1}},
                                       {"iso", {0.62, 0.38, 1}, {0, 1, 0}}}};

}  // namespace

Viewpoint namedViewpoint(const std::string& view, const std::string& up, const std::string& view_culprit,
                         const std::string& up_culprit) {
  const auto* found =
      std::find_if(kViews.begin(), kViews.end(), [&](const Named& named) { return view == named.name; });
  if (found == kViews.end()) {
    throw usageError(view_culprit, "'" + view + "' is none of front, back, left, right, top, bottom, iso");
  }
  if (up != "x" && up != "y" && up != "z") throw usageError(up_culprit, "'" + up + "' is none of x, y, z");
  const int shift = up[0] - 'y' + 3;
  Viewpoint viewpoint;
  for (int i = 0; i < 3; ++i) {
    viewpoint.from[(i + shift) % 3] = found->from[i];
    viewpoint.up[(i + shift) % 3] = found->up[i];
  }
  return viewpoint;
}

}  // namespace mlsmesh::apps

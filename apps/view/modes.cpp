// SPDX-License-Identifier: BSD-3-Clause
#include "view/modes.h"

#include "common/command_line.h"

#include <algorithm>

namespace mlsmesh::apps {

const std::vector<std::string>& modeNames() {
  static const std::vector<std::string> kNames{"cloud",   "clusters", "representatives", "mesh",
                                               "borders", "defects",  "distance"};
  return kNames;
}

Mode modeNamed(const std::string& name, const std::string& culprit) {
  const std::vector<std::string>& names = modeNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end()) return static_cast<Mode>(found - names.begin() + 1);
  std::string list;
  for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
  throw usageError(culprit, "'" + name + "' is none of " + list);
}

bool needsMesh(Mode mode) {
  return mode != Mode::Auto && mode != Mode::Cloud;
}

}  // namespace mlsmesh::apps

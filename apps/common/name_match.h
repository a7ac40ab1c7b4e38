// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// The name nearest to `name` (few letters changed, or its part after the dot), or empty if none is near: for
/// "did you mean".
std::string nearestName(const std::string& name, const std::vector<std::string>& names);

}  // namespace mlsmesh::apps

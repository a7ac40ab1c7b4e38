// SPDX-License-Identifier: BSD-3-Clause
#include "common/name_match.h"

#include <algorithm>
#include <numeric>

namespace mlsmesh::apps {

namespace {

/// Number of insertions, deletions and substitutions that turn one word into the other.
std::size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string nearestName(const std::string& name, const std::vector<std::string>& names) {
  std::string nearest;
  std::size_t least = std::max<std::size_t>(2, name.size() / 4) + 1;
  for (const std::string& candidate : names) {
    const std::size_t dot = candidate.find('.');
    const std::string member = dot == std::string::npos ? candidate : candidate.substr(dot + 1);
    const std::size_t distance = std::min(editDistance(name, candidate), editDistance(name, member) + 1);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace mlsmesh::bench {

/// What the programs of this folder take beside Google Benchmark's options.
struct Options {
  std::string cloud;                ///< --cloud FILE.pcd, or a bare FILE.pcd; empty: the synthetic cloud
  std::vector<std::size_t> points;  ///< --points N[,N]: of the synthetic cloud, each > 0
  std::vector<int> threads{1};      ///< --threads N[,N], each > 0
  std::vector<std::string> flags;   ///< all others that begin with "--", as they are
};

/// Reads argv[1 ..]; `points` where --points is not given. Throws std::invalid_argument that names the
/// culprit.
Options parseOptions(int argc, char** argv, const std::vector<std::size_t>& points);

}  // namespace mlsmesh::bench

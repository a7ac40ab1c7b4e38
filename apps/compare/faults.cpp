// SPDX-License-Identifier: BSD-3-Clause
#include "compare/faults.h"

#include <csignal>
#include <memory>
#include <stdexcept>
#include <vector>

#include <unistd.h>

namespace mlsmesh::apps {

pcl::PolygonMesh crash(const MethodInput& /*input*/, StageClock& /*clock*/) {
  std::raise(SIGSEGV);
  return {};
}

pcl::PolygonMesh hang(const MethodInput& /*input*/, StageClock& /*clock*/) {
  for (;;) pause();
}

pcl::PolygonMesh exhaustMemory(const MethodInput& /*input*/, StageClock& /*clock*/) {
  constexpr std::size_t kBlock = std::size_t{64} << 20;
  std::vector<std::unique_ptr<std::vector<char>>> blocks;
  for (;;) blocks.push_back(std::make_unique<std::vector<char>>(kBlock, '\1'));
}

pcl::PolygonMesh throwError(const MethodInput& /*input*/, StageClock& /*clock*/) {
  throw std::runtime_error("it was asked to fail");
}

pcl::PolygonMesh makeNothing(const MethodInput& /*input*/, StageClock& clock) {
  clock.begin("reconstruction");
  clock.end();
  return {};
}

}  // namespace mlsmesh::apps

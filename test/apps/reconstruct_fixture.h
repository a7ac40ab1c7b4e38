// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "program.h"
#include "sphere_files.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::test {

/// Runs mlsmesh_reconstruct in a folder of its own.
class ReconstructTest : public testing::Test {
 protected:
  Outcome run(const std::vector<std::string>& arguments,
              const std::function<bool()>& prepare = nullptr) const {
    const TemporaryFolder prints;
    return Program(program_, arguments, prints.path(), prepare).wait();
  }

  /// Runs it, expects success without a word on stderr, and returns what it printed.
  std::string runWell(const std::vector<std::string>& arguments) const {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return outcome.out;
  }

  PlyMesh readPly(const std::string& name) const { return parsePly(readFile(folder_.file(name))); }

  TemporaryFolder folder_;
  std::string program_ = MLSMESH_RECONSTRUCT;
};

}  // namespace mlsmesh::test

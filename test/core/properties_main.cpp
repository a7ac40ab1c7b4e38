// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cstdlib>

// The same cases in every run, unless RC_PARAMS asks for others, or for more: "seed=7 max_success=2000".
int main(int argc, char** argv) {
  constexpr int kKeep = 0;
  setenv("RC_PARAMS", "seed=2003 max_success=20", kKeep);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}

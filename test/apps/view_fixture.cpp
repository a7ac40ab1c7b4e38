// SPDX-License-Identifier: BSD-3-Clause
#include "view_fixture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mlsmesh::test {

bool dropDisplay() {
  return unsetenv("DISPLAY") == 0;
}

Outcome runView(const std::vector<std::string>& arguments, const std::function<bool()>& prepare) {
  const TemporaryFolder prints;
  return Program(MLSMESH_VIEW, arguments, prints.path(), prepare).wait();
}

void expectOneLine(const Outcome& outcome, int exit_code, const std::string& culprit) {
  EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
  EXPECT_EQ(outcome.err.rfind("mlsmesh_view: ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find(culprit), std::string::npos) << outcome.err;
}

std::string bandText() {
  constexpr int kCount = 1500;
  std::string text;
  for (int i = 0; i < kCount; ++i) {
    const double z = 0.8 * (2 * (i + 0.5) / kCount - 1), radius = std::sqrt(1 - z * z), angle = 2.399963 * i;
    text += std::to_string(radius * std::cos(angle)) + " " + std::to_string(radius * std::sin(angle)) + " " +
            std::to_string(z) + "\n";
  }
  return text;
}

}  // namespace mlsmesh::test

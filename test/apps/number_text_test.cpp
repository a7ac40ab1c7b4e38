// SPDX-License-Identifier: BSD-3-Clause
#include "common/number_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <regex>
#include <string>

namespace mlsmesh::apps {
namespace {

const std::regex kGroups("-?[0-9]{1,3}(,[0-9]{3})*");

double valueOf(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ','), text.end());
  return std::stod(text);
}

TEST(NumberText, CommasStandBetweenThreeDigitsAndChangeNoNumber) {
  for (std::uint64_t number = 1; number < std::uint64_t{1} << 60; number *= 3) {
    for (const std::uint64_t near : {number - 1, number, number + 1}) {
      std::string text = withCommas(near);
      EXPECT_TRUE(std::regex_match(text, kGroups)) << text;
      text.erase(std::remove(text.begin(), text.end(), ','), text.end());
      EXPECT_EQ(text, std::to_string(near));
    }
  }
  EXPECT_EQ(withCommas(999), "999");
  EXPECT_EQ(withCommas(1000), "1,000");
}

TEST(NumberText, ReadableOnesAreNearAndHaveNoExponent) {
  for (double value = 1.001e-4; value < 9e14; value *= 1.37) {
    for (const double one : {value, -value}) {
      const std::string text = readableText(one);
      EXPECT_EQ(text.find('e'), std::string::npos) << text;
      EXPECT_NEAR(valueOf(text), one, 0.005001 * std::abs(one)) << text;
      if (value >= 100) {
        EXPECT_TRUE(std::regex_match(text, kGroups)) << text;
        EXPECT_LE(std::abs(valueOf(text) - one), 0.5);
      }
    }
  }
}

TEST(NumberText, ReadableOnesAtTheEdges) {
  EXPECT_EQ(readableText(0), "0");
  EXPECT_EQ(readableText(-0.0), "0");
  EXPECT_EQ(readableText(3.83e-21), "< 0.0001");
  EXPECT_EQ(readableText(-3.83e-21), "> -0.0001");
  EXPECT_EQ(readableText(1e-4), "0.0001");
  EXPECT_EQ(readableText(99.94), "99.9");
  EXPECT_EQ(readableText(99.96), "100");
  EXPECT_EQ(readableText(999.6), "1,000");
  EXPECT_EQ(readableText(1.12e3), "1,120");
  EXPECT_EQ(wholeText(-0.2), "0");
  EXPECT_EQ(wholeText(-1234.5), "-1,235");
  EXPECT_EQ(wholeText(1.23e20), "1.23e+20");
  EXPECT_EQ(readableText(std::numeric_limits<double>::infinity()), "–");
  EXPECT_EQ(readableText(std::nan("")), "–");
}

}  // namespace
}  // namespace mlsmesh::apps

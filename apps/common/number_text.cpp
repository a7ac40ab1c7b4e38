// SPDX-License-Identifier: BSD-3-Clause
#include "common/number_text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace mlsmesh::apps {
namespace {

constexpr double kSmallest = 1e-4;  // of what is told from 0
constexpr double kMostDigits = 1e15;
constexpr double kAllDigits = 99.95;  // from here on three digits are no fewer than those before the point

std::string threeDigits(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

}  // namespace

std::string withCommas(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, ",");
  return text;
}

std::string wholeText(double value) {
  if (!std::isfinite(value)) return "–";
  if (std::abs(value) >= kMostDigits) return threeDigits(value);
  const long long whole = std::llround(value);
  return (whole < 0 ? "-" : "") + withCommas(static_cast<std::uint64_t>(std::abs(whole)));
}

std::string readableText(double value) {
  if (!std::isfinite(value) || std::abs(value) >= kAllDigits) return wholeText(value);
  if (value == 0) return "0";
  if (std::abs(value) < kSmallest) return value > 0 ? "< 0.0001" : "> -0.0001";
  return threeDigits(value);
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace mlsmesh::apps {

/// "1,234,567".
std::string withCommas(std::uint64_t number);

/// The nearest whole number, with commas; "–" if it is none, as "1.23e+20" what has more than 15 digits.
std::string wholeText(double value);

/// As people like to read a measurement: three significant digits, but all those before the point ("12,346"),
/// and "< 0.0001" for a smaller one that is not 0 (that of a negative one is "> -0.0001"); "–" if it is none.
std::string readableText(double value);

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace mlsmesh::apps {

/// A space at which no line ends.
inline constexpr const char* kNoBreak = "\u00A0";

/// An HTML element; content and attributes are markup already.
std::string element(const std::string& tag, const std::string& content, const std::string& attributes = "");

/// Plain text as markup in which no number is parted from the % behind it.
std::string prose(const std::string& text);

/// Mark, number (from 1) and name of the method of a row (from 0).
std::string numbered(std::size_t row, const std::string& label);

}  // namespace mlsmesh::apps

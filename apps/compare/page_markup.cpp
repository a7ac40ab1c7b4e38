// SPDX-License-Identifier: BSD-3-Clause
#include "compare/page_markup.h"

#include "compare/plots.h"

#include <boost/algorithm/string/replace.hpp>

namespace mlsmesh::apps {

std::string element(const std::string& tag, const std::string& content, const std::string& attributes) {
  return "<" + tag + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + tag + ">";
}

std::string prose(const std::string& text) {
  return boost::replace_all_copy(escaped(text), " %", std::string(kNoBreak) + "%");
}

std::string numbered(std::size_t row, const std::string& label) {
  const int number = static_cast<int>(row) + 1;
  return markIcon(number) + std::to_string(number) + "&ensp;" + escaped(label);
}

}  // namespace mlsmesh::apps

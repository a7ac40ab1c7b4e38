// SPDX-License-Identifier: BSD-3-Clause
#include "options.h"

#include <limits>
#include <sstream>
#include <stdexcept>

namespace mlsmesh::bench {
namespace {

template <typename Number>
std::vector<Number> numbers(const std::string& option, const std::string& text) {
  std::vector<Number> result;
  std::istringstream list(text);
  for (std::string item; std::getline(list, item, ',');) {
    const bool digits = !item.empty() && item.find_first_not_of("0123456789") == std::string::npos;
    const unsigned long long value = digits && item.size() < 19 ? std::stoull(item) : 0;
    if (value == 0 || value > static_cast<unsigned long long>(std::numeric_limits<Number>::max())) {
      throw std::invalid_argument(option + ": not a positive number: '" + item + "'");
    }
    result.push_back(static_cast<Number>(value));
  }
  if (result.empty()) throw std::invalid_argument(option + ": needs a number, or several with commas");
  return result;
}

}  // namespace

Options parseOptions(int argc, char** argv, const std::vector<std::size_t>& points) {
  Options options;
  options.points = points;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const bool takes_value = word == "--cloud" || word == "--points" || word == "--threads";
    if (takes_value && i + 1 == argc) throw std::invalid_argument(word + ": needs a value");
    if (word == "--cloud") {
      options.cloud = argv[++i];
    } else if (word == "--points") {
      options.points = numbers<std::size_t>(word, argv[++i]);
    } else if (word == "--threads") {
      options.threads = numbers<int>(word, argv[++i]);
    } else if (word.compare(0, 2, "--") == 0) {
      options.flags.push_back(word);
    } else {
      options.cloud = word;
    }
  }
  return options;
}

}  // namespace mlsmesh::bench

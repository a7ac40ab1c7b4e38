// SPDX-License-Identifier: BSD-3-Clause
#include "common/command_line.h"

#include "common/name_match.h"

#include <cmath>
#include <locale>
#include <sstream>
#include <utility>
#include <vector>

namespace mlsmesh::apps {
namespace {

namespace po = boost::program_options;

/// The option without leading dashes.
std::string bareName(const std::string& option) {
  const std::size_t first = option.find_first_not_of('-');
  return first == std::string::npos ? std::string() : option.substr(first);
}

AppError unknownOption(const std::string& option, const po::options_description& options) {
  std::vector<std::string> names;
  for (const auto& known : options.options()) names.push_back(known->long_name());
  const std::string nearest = nearestName(bareName(option), names);
  return usageError(
      option, "no such option; " + (nearest.empty() ? "see --help" : "did you mean --" + nearest + "?"));
}

/// An option whose value can be left out, alone in its word, and the value that it has then: without this the
/// parser would take the next argument, which is a file, for its value. Empty if the word is another thing.
std::pair<std::string, std::string> withImpliedValue(const std::string& word,
                                                     const po::options_description& options) {
  if (word.rfind('-', 0) != 0) return {};
  const po::option_description* option = options.find_nothrow(bareName(word), false);
  if (option == nullptr || option->semantic()->min_tokens() > 0 || option->semantic()->max_tokens() != 1)
    return {};
  boost::any value;
  option->semantic()->parse(value, {}, true);
  return {bareName(word), boost::any_cast<std::string>(value)};
}

}  // namespace

AppError usageError(const std::string& culprit, const std::string& what_and_remedy) {
  return {kExitUsage, culprit + ": " + what_and_remedy};
}

po::variables_map parseCommandLine(int argc, const char* const* argv, const po::options_description& options,
                                   const po::positional_options_description& positions) {
  namespace style = po::command_line_style;
  constexpr int kStyle = style::allow_long | style::long_allow_adjacent | style::long_allow_next |
                         style::allow_long_disguise | style::allow_short | style::allow_dash_for_short |
                         style::short_allow_next;
  const auto flags = [&](const std::string& word) { return withImpliedValue(word, options); };
  po::variables_map values;
  try {
    po::command_line_parser parser(argc, argv);
    po::store(parser.options(options).positional(positions).style(kStyle).extra_parser(flags).run(), values);
  } catch (const po::unknown_option& error) {
    throw unknownOption(error.get_option_name(), options);
  } catch (const po::too_many_positional_options_error&) {
    throw usageError("arguments", "too many of them; see --help");
  } catch (const po::error_with_option_name& error) {
    throw usageError(error.get_option_name(), std::string(error.what()) + "; see --help");
  } catch (const po::error& error) {
    throw usageError("arguments", std::string(error.what()) + "; see --help");
  }
  return values;
}

double numberFromText(const std::string& culprit, const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0.0;
  if (stream >> value && stream.eof() && std::isfinite(value)) return value;
  throw usageError(culprit, "'" + text + "' is not a number; give one such as 0.01");
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_table.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>

namespace mlsmesh::apps {

namespace {

std::string listed(const std::vector<std::string>& choices) {
  std::string text;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (i > 0) text += i + 1 == choices.size() ? " or " : ", ";
    text += choices[i];
  }
  return text;
}

std::string limitText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string exactText(double value) {
  char text[32];
  const std::to_chars_result end = std::to_chars(text, text + sizeof text, value);
  return {text, end.ptr};
}

bool numberFromText(const std::string& text, double& value) {
  const char* last = text.data() + text.size();
  const std::from_chars_result end = std::from_chars(text.data(), last, value);
  return end.ec == std::errc() && end.ptr == last && std::isfinite(value);
}

double largest(const Parameter& parameter) {
  const bool whole = parameter.kind == ParameterKind::Whole;
  return whole ? std::min(parameter.high, static_cast<double>(std::numeric_limits<int>::max()))
               : parameter.high;
}

bool inRange(const Parameter& parameter, double value) {
  if (parameter.kind == ParameterKind::Whole && value != std::floor(value)) return false;
  if (parameter.zero_is_off && value == 0) return true;
  if (value > largest(parameter)) return false;
  return parameter.above_low ? value > parameter.low : value >= parameter.low;
}

bool parse(const Parameter& parameter, const std::string& text, double& value) {
  if (parameter.kind == ParameterKind::Choice) {
    const auto found = std::find(parameter.choices.begin(), parameter.choices.end(), text);
    value = static_cast<double>(found - parameter.choices.begin());
    return found != parameter.choices.end();
  }
  if (parameter.kind == ParameterKind::Boolean) {
    bool flag = false;
    const bool known = booleanFromText(text, flag);
    value = flag ? 1 : 0;
    return known;
  }
  return numberFromText(text, value) && inRange(parameter, value);
}

}  // namespace

bool booleanFromText(const std::string& text, bool& value) {
  value = text == "true" || text == "on" || text == "yes" || text == "1";
  return value || text == "false" || text == "off" || text == "no" || text == "0";
}

void setFromText(const Parameter& parameter, const std::string& text, MultiresolutionParameters& parameters) {
  double value = 0;
  if (!parse(parameter, text, value)) {
    const bool whole = parameter.kind == ParameterKind::Whole;
    throw ParameterError("parameter '" + parameter.name + "' cannot be '" + text +
                         "'; allowed: " + (whole ? "a whole number, " : "") + rangeText(parameter));
  }
  parameter.set(parameters, value);
}

std::string valueText(const Parameter& parameter, const MultiresolutionParameters& parameters) {
  const double value = parameter.get(parameters);
  if (parameter.kind == ParameterKind::Choice) return parameter.choices.at(static_cast<std::size_t>(value));
  if (parameter.kind == ParameterKind::Boolean) return value != 0 ? "true" : "false";
  return exactText(value);
}

std::string rangeText(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::Choice) return listed(parameter.choices);
  if (parameter.kind == ParameterKind::Boolean) return "true or false";
  const std::string zero = parameter.zero_is_off ? "0 or " : "";
  if (std::isinf(parameter.high))
    return zero + (parameter.above_low ? "> " : ">= ") + limitText(parameter.low);
  return zero + limitText(parameter.low) + " .. " + limitText(parameter.high);
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
// The table of the programs against what the core accepts.
#include "common/parameter_table.h"

#include "mlsmesh/core/failure.h"
#include "mlsmesh/core/parameter_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace mlsmesh::apps {

namespace {

/// Whether the core accepts a value; empty if so, otherwise its text.
std::string complaintAbout(const Parameter& parameter, double value) {
  MultiresolutionParameters parameters;
  parameter.set(parameters, value);
  try {
    core::check(parameters);
  } catch (const core::Failure& failure) {
    return failure.what();
  }
  return "";
}

bool isNumber(const Parameter& parameter) {
  return parameter.kind == ParameterKind::Whole || parameter.kind == ParameterKind::Real;
}

/// The nearest value of the parameter's kind beyond `value`.
double beyond(const Parameter& parameter, double value, double direction) {
  return parameter.kind == ParameterKind::Whole ? value + direction
                                                : std::nextafter(value, direction * INFINITY);
}

TEST(ParameterTable, NamesAreUnique) {
  std::set<std::string> names;
  for (const Parameter& parameter : parameterTable()) {
    EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    EXPECT_EQ(findParameter(parameter.name), &parameter);
    EXPECT_FALSE(parameter.help.empty()) << parameter.name;
  }
  EXPECT_EQ(findParameter("levels"), findParameter("refinement.levels"));
  EXPECT_EQ(findParameter("nothing"), nullptr);
}

TEST(ParameterTable, LimitsAreThoseOfTheCore) {
  for (const Parameter& parameter : parameterTable()) {
    if (!isNumber(parameter)) continue;
    SCOPED_TRACE(parameter.name);
    const double lowest = parameter.above_low ? beyond(parameter, parameter.low, 1) : parameter.low;
    EXPECT_EQ(complaintAbout(parameter, lowest), "");
    const double below = parameter.above_low ? parameter.low : beyond(parameter, parameter.low, -1);
    if (!(parameter.zero_is_off && below == 0)) {
      EXPECT_EQ(complaintAbout(parameter, below).rfind(parameter.name + " is ", 0), 0u);
    }
    if (parameter.zero_is_off) {
      EXPECT_EQ(complaintAbout(parameter, 0), "");
    }
    if (std::isinf(parameter.high)) continue;
    EXPECT_EQ(complaintAbout(parameter, parameter.high), "");
    EXPECT_NE(complaintAbout(parameter, beyond(parameter, parameter.high, 1)), "");
  }
}

TEST(ParameterTable, TextIsReadBackExactly) {
  for (const Preset& preset : presetTable()) {
    const MultiresolutionParameters source = preset.make();
    MultiresolutionParameters copy;
    for (const Parameter& parameter : parameterTable()) {
      setFromText(parameter, valueText(parameter, source), copy);
      EXPECT_EQ(parameter.get(copy), parameter.get(source)) << preset.name << " " << parameter.name;
    }
  }
}

TEST(ParameterTable, EveryChoiceHasItsOwnValue) {
  for (const Parameter& parameter : parameterTable()) {
    if (parameter.kind != ParameterKind::Choice) continue;
    for (std::size_t i = 0; i < parameter.choices.size(); ++i) {
      MultiresolutionParameters parameters;
      setFromText(parameter, parameter.choices[i], parameters);
      EXPECT_EQ(parameter.get(parameters), static_cast<double>(i)) << parameter.name;
    }
  }
}

TEST(ParameterTable, RefusesWhatIsNoValue) {
  MultiresolutionParameters parameters;
  for (const char* text : {"", " ", "x", "1x", "nan", "inf", "1e999", "0x10"}) {
    EXPECT_THROW(setFromText(*findParameter("refinement.threshold"), text, parameters), ParameterError)
        << text;
    EXPECT_THROW(setFromText(*findParameter("levels"), text, parameters), ParameterError) << text;
    EXPECT_THROW(setFromText(*findParameter("reduce"), text, parameters), ParameterError) << text;
    EXPECT_THROW(setFromText(*findParameter("projection.method"), text, parameters), ParameterError) << text;
  }
}

}  // namespace

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/parameters.h"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace mlsmesh::apps {

enum class ParameterKind { Whole, Real, Boolean, Choice };

/// One parameter as the user meets it on the command line, in config files, in the help and in
/// docs/parameters.md: the table of these is the one place where its name, range and explanation stand.
/// Defaults are those of the presets.
struct Parameter {
  std::string name;    ///< "step.member", as in mlsmesh/parameters.h
  std::string alias;   ///< a second, shorter name, or empty
  std::string help;    ///< one sentence, with the unit
  std::string symbol;  ///< the paper's, or empty
  ParameterKind kind = ParameterKind::Real;
  double low = 0;                    ///< smallest value
  double high = 0;                   ///< largest value, may be infinite
  bool above_low = false;            ///< `low` itself is not allowed
  bool zero_is_off = false;          ///< 0 is allowed, too, whatever `low`
  std::vector<std::string> choices;  ///< names of the values 0, 1, ... of a Choice
  std::function<double(const MultiresolutionParameters&)> get;
  std::function<void(MultiresolutionParameters&, double)> set;
};

/// A named set of parameters.
struct Preset {
  std::string name;
  std::string help;
  MultiresolutionParameters (*make)();
};

/// A value that a parameter cannot take; the text names the parameter, the value and what is allowed.
class ParameterError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All parameters of the pipeline, step by step.
const std::vector<Parameter>& parameterTable();
/// By name or alias; null if there is none.
const Parameter* findParameter(const std::string& name);
const std::vector<Preset>& presetTable();
/// Null if there is none of that name.
const Preset* findPreset(const std::string& name);

/// Reads `text` into the parameter. Booleans: true, false, on, off, yes, no, 1, 0. Throws ParameterError.
void setFromText(const Parameter& parameter, const std::string& text, MultiresolutionParameters& parameters);
/// Reads a boolean of that kind; false if `text` is none.
bool booleanFromText(const std::string& text, bool& value);
/// The value as setFromText reads it back, exactly.
std::string valueText(const Parameter& parameter, const MultiresolutionParameters& parameters);
/// "0 .. 10", "> 0", "true or false", "largest_spread or regression_plane".
std::string rangeText(const Parameter& parameter);

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "common/parameter_help.h"

#include "common/parameter_table.h"

#include <sstream>

namespace mlsmesh::apps {

namespace {

constexpr std::size_t kLineWidth = 100;

/// `text` in lines of limited width, each after `indent` blanks.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::istringstream words(text);
  std::string lines;
  std::string line(indent, ' ');
  for (std::string word; words >> word;) {
    if (line.size() > indent && line.size() + 1 + word.size() > kLineWidth) {
      lines += line + "\n";
      line.assign(indent, ' ');
    }
    if (line.size() > indent) line += ' ';
    line += word;
  }
  return lines + line + "\n";
}

/// "clustering" of "clustering.max_size"; "general" of a name without a dot.
std::string stepOf(const Parameter& parameter) {
  const std::size_t dot = parameter.name.find('.');
  return dot == std::string::npos ? "general" : parameter.name.substr(0, dot);
}

std::string explanation(const Parameter& parameter) {
  std::string text = parameter.help;
  if (!parameter.alias.empty()) text += " (short name: " + parameter.alias + ")";
  if (!parameter.symbol.empty()) text += " [" + parameter.symbol + "]";
  return text;
}

std::string markdownRow(const Parameter& parameter) {
  const std::string standard = valueText(parameter, defaultPreset());
  std::string row = "| `" + parameter.name + "` |";
  for (const Preset& preset : presetTable()) {
    const std::string value = valueText(parameter, preset.make());
    row += preset.name == "default" || value != standard ? " " + value + " |" : " |";
  }
  return row + " " + rangeText(parameter) + " | " + explanation(parameter) + " |\n";
}

std::string markdownHeading() {
  std::string names;
  std::string rule;
  for (const Preset& preset : presetTable()) {
    names += " " + preset.name + " |";
    rule += " --- |";
  }
  return "| parameter |" + names + " allowed | meaning |\n| --- |" + rule + " --- | --- |\n";
}

}  // namespace

std::string parameterHelp() {
  std::string text;
  for (const Parameter& parameter : parameterTable()) {
    text += "  --" + parameter.name + " VALUE\n";
    text += wrapped(explanation(parameter) + "; " + rangeText(parameter) + "; default " +
                        valueText(parameter, defaultPreset()),
                    6);
  }
  return text;
}

std::string parameterMarkdown() {
  std::string page =
      "# Parameters\n\n"
      "Printed by `mlsmesh_reconstruct --list-parameters=markdown`; change the table in the program, not "
      "this page.\n\n"
      "The same names serve on the command line (`--triangulation.neighbors 16`), in config files\n"
      "(`triangulation.neighbors = 16`) and, without the step, in the structs of `mlsmesh/parameters.h`.\n"
      "Lengths are multiples of spacing, so that the defaults suit every scale: \"local spacing\" is that of "
      "the place,\n"
      "\"spacing\" that of the whole cloud. Symbols in [brackets] are the paper's.\n\n"
      "Presets:\n\n";
  for (const Preset& preset : presetTable()) page += "- `" + preset.name + "`: " + preset.help + ".\n";
  page += "\nThe columns of the other presets are empty where they agree with `default`.\n";
  std::string step;
  for (const Parameter& parameter : parameterTable()) {
    if (stepOf(parameter) != step) {
      step = stepOf(parameter);
      page += "\n## " + step + "\n\n" + markdownHeading();
    }
    page += markdownRow(parameter);
  }
  return page;
}

std::string parameterConfig(const MultiresolutionParameters& parameters) {
  std::string text;
  std::string step = "general";
  for (const Parameter& parameter : parameterTable()) {
    if (stepOf(parameter) != step) text += "\n";
    step = stepOf(parameter);
    text += parameter.name + " = " + valueText(parameter, parameters) + "\n";
  }
  return text;
}

}  // namespace mlsmesh::apps

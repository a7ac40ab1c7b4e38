// SPDX-License-Identifier: BSD-3-Clause
#include "compare/our_parameters.h"

#include "common/parameter_table.h"

namespace mlsmesh::apps {

std::string parametersText(const ReconstructionOptions& options) {
  const Json json = parametersJson(options);
  std::string text = options.preset == "default" ? "default parameters" : "preset " + options.preset;
  for (const auto& [name, value] : json.at("changed").items())
    text += ", " + name + " = " + value.get<std::string>();
  return text;
}

Json parametersJson(const ReconstructionOptions& options) {
  const MultiresolutionParameters preset = findPreset(options.preset)->make();
  Json changed = Json::object();
  for (const Parameter& parameter : parameterTable()) {
    const std::string value = valueText(parameter, options.parameters);
    if (value != valueText(parameter, preset)) changed[parameter.name] = value;
  }
  return {{"preset", options.preset}, {"changed", changed}};
}

MultiresolutionParameters parametersOf(const Json& json) {
  MultiresolutionParameters parameters = findPreset(json.at("preset"))->make();
  for (const auto& [name, value] : json.at("changed").items())
    setFromText(*findParameter(name), value.get<std::string>(), parameters);
  return parameters;
}

}  // namespace mlsmesh::apps

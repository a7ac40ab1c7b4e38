// SPDX-License-Identifier: BSD-3-Clause
#include "view/script.h"

#include "common/command_line.h"
#include "drawing/picture.h"
#include "view/keys.h"

#include <sstream>

namespace mlsmesh::apps {
namespace {

ScriptStep parseStep(const std::string& text) {
  const std::size_t equals = text.find('=');
  ScriptStep step{text.substr(0, equals), equals == std::string::npos ? "" : text.substr(equals + 1)};
  if (step.key == kWaitStep && equals == std::string::npos) return step;
  const Key* key = findKey(step.key);
  if (key == nullptr)
    throw usageError("--script",
                     "'" + step.key + "' is no key; give keys of --help, or wait, between commas");
  if (equals == std::string::npos) return step;
  if (key->action != Action::Picture)
    throw usageError("--script", "'" + text + "': only p=FILE takes a name; leave out what follows the key");
  checkPictureFormat("--script", step.argument);
  return step;
}

}  // namespace

std::vector<ScriptStep> parseScript(const std::string& text) {
  std::vector<ScriptStep> steps;
  std::istringstream stream(text);
  for (std::string step; std::getline(stream, step, ',');) steps.push_back(parseStep(step));
  if (steps.empty()) throw usageError("--script", "is empty; give keys between commas, such as m,Up,q");
  return steps;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "inspect/requirements.h"

#include "common/command_line.h"
#include "common/name_match.h"
#include "common/parameter_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace mlsmesh::apps {

namespace {

using Relation = Requirement::Relation;

struct Sign {
  const char* text;
  Relation relation;
};

/// The longer ones first.
constexpr std::array<Sign, 7> kSigns = {{{"==", Relation::Equal},
                                         {"!=", Relation::NotEqual},
                                         {"<=", Relation::AtMost},
                                         {">=", Relation::AtLeast},
                                         {"=", Relation::Equal},
                                         {"<", Relation::Below},
                                         {">", Relation::Above}}};

AppError unreadable(const std::string& part) {
  return usageError("--require", "'" + part + "' is not NAME=VALUE; give for example components=1, " +
                                     "border_loops<=3 or closed=true");
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

double valueFromText(const std::string& text, const std::string& part) {
  bool flag = false;
  const bool is_word = !text.empty() && text.find_first_of("0123456789") == std::string::npos;
  if (is_word && booleanFromText(text, flag)) return flag ? 1 : 0;
  if (text.empty() || is_word) throw unreadable(part);
  return numberFromText("--require '" + part + "'", text);
}

Requirement requirementFromText(const std::string& part) {
  const std::size_t at = part.find_first_of("=!<>");
  if (at == std::string::npos) throw unreadable(part);
  const auto* sign = std::find_if(kSigns.begin(), kSigns.end(), [&](const Sign& candidate) {
    return part.compare(at, std::string(candidate.text).size(), candidate.text) == 0;
  });
  if (sign == kSigns.end()) throw unreadable(part);
  Requirement requirement;
  requirement.text = part;
  requirement.name = trimmed(part.substr(0, at));
  requirement.relation = sign->relation;
  if (requirement.name.empty()) throw unreadable(part);
  requirement.value = valueFromText(trimmed(part.substr(at + std::string(sign->text).size())), part);
  return requirement;
}

bool isEqual(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool holds(double figure, Relation relation, double value) {
  if (std::isnan(figure)) return false;
  switch (relation) {
    case Relation::Equal:
      return isEqual(figure, value);
    case Relation::NotEqual:
      return !isEqual(figure, value);
    case Relation::AtMost:
      return figure <= value;
    case Relation::AtLeast:
      return figure >= value;
    case Relation::Below:
      return figure < value;
    case Relation::Above:
      return figure > value;
  }
  return false;
}

std::string joined(const std::vector<const Figure*>& figures) {
  std::string list;
  for (const Figure* figure : figures) list += (list.empty() ? "" : " or ") + figure->path();
  return list;
}

void checkName(const Requirement& requirement, const FigureTable& table, const FigureTable& every) {
  const std::vector<const Figure*> found = table.find(requirement.name);
  if (found.size() == 1) return;
  const std::string culprit = "--require '" + requirement.text + "'";
  if (found.size() > 1)
    throw usageError(culprit, "'" + requirement.name + "' is ambiguous; give " + joined(found));
  const std::vector<const Figure*> other = every.find(requirement.name);
  if (!other.empty()) {
    const bool needs_cloud = other.front()->group.find("cloud") != std::string::npos;
    throw usageError(culprit, "'" + other.front()->path() + "' is measured only with " +
                                  (needs_cloud ? "--cloud FILE" : "--truth FILE") + "; add it");
  }
  const std::string nearest = nearestName(requirement.name, every.names());
  throw usageError(culprit, "no figure '" + requirement.name + "'; " +
                                (nearest.empty() ? "see --help" : "did you mean '" + nearest + "'?"));
}

}  // namespace

std::vector<Requirement> requirementsFromText(const std::string& list) {
  std::vector<Requirement> requirements;
  std::istringstream parts(list);
  for (std::string part; std::getline(parts, part, ',');)
    requirements.push_back(requirementFromText(trimmed(part)));
  if (requirements.empty() || list.back() == ',') throw unreadable("");
  return requirements;
}

void checkNames(const std::vector<Requirement>& requirements, const FigureTable& table,
                const FigureTable& every) {
  for (const Requirement& requirement : requirements) checkName(requirement, table, every);
}

std::vector<std::string> failures(const std::vector<Requirement>& requirements, const FigureTable& table) {
  std::vector<std::string> sentences;
  for (const Requirement& requirement : requirements) {
    const Figure& figure = *table.find(requirement.name).front();
    if (holds(figure.value, requirement.relation, requirement.value)) continue;
    sentences.push_back("'" + requirement.text + "' does not hold: " + figure.path() +
                        (std::isnan(figure.value) ? " has no value" : " is " + figure.text()));
  }
  return sentences;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "compare/results.h"

#include "mlsmesh/statistics.h"

#include <array>
#include <stdexcept>

namespace mlsmesh::apps {
namespace {

struct Words {
  RowStatus status;
  const char* name;
  const char* words;
};

constexpr std::array<Words, 7> kStatuses{{{RowStatus::Done, "done", "done"},
                                          {RowStatus::Empty, "empty", "no faces"},
                                          {RowStatus::Refused, "refused", "refused"},
                                          {RowStatus::OverTime, "over_time", "over the time limit"},
                                          {RowStatus::OverMemory, "over_memory", "over the memory limit"},
                                          {RowStatus::Crashed, "crashed", "crashed"},
                                          {RowStatus::Failed, "failed", "failed"}}};

const Words& find(RowStatus status) {
  return kStatuses.at(static_cast<std::size_t>(status));
}

bool isOfNormals(const StageSeconds& stage) {
  return stage.name == "normals" || stage.name == "orientation";
}

}  // namespace

std::string nameOf(RowStatus status) {
  return find(status).name;
}

RowStatus statusFromName(const std::string& name) {
  for (const Words& words : kStatuses)
    if (name == words.name) return words.status;
  throw std::invalid_argument("no status " + name);
}

std::string wordsOf(RowStatus status) {
  return find(status).words;
}

double Row::normalSeconds() const {
  double sum = 0;
  for (const StageSeconds& stage : stages) sum += isOfNormals(stage) ? stage.seconds : 0;
  return sum;
}

double Row::methodSeconds() const {
  double sum = 0;
  for (const StageSeconds& stage : stages) sum += isOfNormals(stage) ? 0 : stage.seconds;
  return sum;
}

double Row::figure(const std::string& group, const std::string& name) const {
  if (!report.is_object() || !report.contains(group) || !report.at(group).contains(name)) return kUnknown;
  const Json& value = report.at(group).at(name);
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  return value.is_number() ? value.get<double>() : kUnknown;
}

}  // namespace mlsmesh::apps

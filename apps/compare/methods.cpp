// SPDX-License-Identifier: BSD-3-Clause
#include "compare/methods.h"

#include "common/command_line.h"
#include "common/name_match.h"
#include "compare/faults.h"
#include "compare/reconstructors.h"

#include <algorithm>
#include <set>
#include <sstream>

namespace mlsmesh::apps {
namespace {

constexpr const char* kOurs = "mlsmesh";
constexpr const char* kPaper = "paper";
constexpr const char* kPcl = "pcl";
constexpr const char* kFault = "fault";

std::function<pcl::PolygonMesh(const MethodInput&, StageClock&)> level(int number) {
  return [number](const MethodInput& input, StageClock& clock) {
    return reconstructLevel(input, number, clock);
  };
}

std::function<pcl::PolygonMesh(const MethodInput&, StageClock&)> paperLevel(int number) {
  return [number](const MethodInput& input, StageClock& clock) {
    return reconstructPaperLevel(input, number, clock);
  };
}

std::function<pcl::PolygonMesh(const MethodInput&, StageClock&)> poisson(int depth) {
  return [depth](const MethodInput& input, StageClock& clock) {
    return reconstructPoisson(input, depth, clock);
  };
}

std::vector<Method> makeTable() {
  const std::string oriented = "normals of 20 neighbours, oriented along a spanning tree of 10 neighbours; ";
  const std::string greedy = "radius 5 s, mu 2.5, 100 neighbours, angles 10 to 120 degrees, 45 across";
  return {
      {"level-0", "mlsmesh, level 0", kOurs, "no refinement", level(0)},
      {"level-1", "mlsmesh, level 1", kOurs, "one refinement step", level(1)},
      {"level-2", "mlsmesh, level 2", kOurs, "two refinement steps", level(2)},
      {"no-reduction", "mlsmesh, all points", kOurs, "reduce = false: the points are the vertices",
       reconstructUnreduced},
      {"paper-0", "mlsmesh, paper, level 0", kPaper, "preset paper, no refinement", paperLevel(0)},
      {"paper-1", "mlsmesh, paper, level 1", kPaper, "preset paper, one refinement step", paperLevel(1)},
      {"paper-2", "mlsmesh, paper, level 2", kPaper, "preset paper, two refinement steps", paperLevel(2)},
      {"gp3", "Greedy projection", kPcl, "normals of 20 neighbours, towards the origin; " + greedy,
       projectGreedily},
      {"gp3-oriented", "Greedy projection, oriented", kPcl,
       oriented + greedy + "; consistent normals and vertex order", projectGreedilyOriented},
      {"mls-gp3", "MLS + greedy projection", kPcl, "MLS of order 2, radius 5 s, with normals; " + greedy,
       projectGreedilySmoothed},
      {"poisson-8", "Poisson, depth 8", kPcl, oriented + "depth 8 (PCL's default)", poisson(8)},
      {"poisson-9", "Poisson, depth 9", kPcl, oriented + "depth 9", poisson(9)},
      {"hoppe", "Marching cubes, Hoppe", kPcl,
       oriented + "cells of 1.5 s, at most 200 a side; corners merged", marchHoppe},
      {"rbf", "Marching cubes, RBF", kPcl,
       oriented + "cells of 1.5 s, at most 60 a side, displacement s; corners merged; at most " +
           std::to_string(kMostRbfPoints) + " points",
       marchRbf},
      {"grid-projection", "Grid projection", kPcl,
       oriented + "cells of 2 s, padding 3, 100 neighbours; corners merged", projectGrid},
      {"organized", "Organised fast mesh", kPcl,
       "adaptive cut, pixel size 1, edges of at most 5 s; organised clouds only", meshOrganized},
      {"fault-crash", "Crashes", kFault, "", crash},
      {"fault-hang", "Hangs", kFault, "", hang},
      {"fault-memory", "Exhausts memory", kFault, "", exhaustMemory},
      {"fault-error", "Throws", kFault, "", throwError},
      {"fault-empty", "Makes nothing", kFault, "", makeNothing},
  };
}

bool isMeant(const Method& method, const std::string& word) {
  if (word == "all") return method.group == kOurs || method.group == kPcl;
  return method.name == word || (method.group != kFault && method.group == word);
}

AppError unknownMethod(const std::string& word, const std::string& culprit) {
  std::vector<std::string> names;
  std::string list;
  for (const Method& method : methodTable()) {
    if (method.group == kFault) continue;
    names.push_back(method.name);
    list += (list.empty() ? "" : ", ") + method.name;
  }
  const std::string nearest = nearestName(word, names);
  return usageError(culprit, "no method '" + word + "'; " +
                                 (nearest.empty() ? "there are " + list + ", and all, mlsmesh, paper, pcl"
                                                  : "did you mean '" + nearest + "'?"));
}

}  // namespace

bool takesParameters(const Method& method) {
  return method.group == kOurs;
}

const std::vector<Method>& methodTable() {
  static const std::vector<Method> table = makeTable();
  return table;
}

const Method* findMethod(const std::string& name) {
  for (const Method& method : methodTable())
    if (method.name == name) return &method;
  return nullptr;
}

std::vector<const Method*> methodsFromText(const std::string& list, const std::string& culprit) {
  std::set<const Method*> wanted;
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');) {
    bool known = false;
    for (const Method& method : methodTable()) {
      if (!isMeant(method, word)) continue;
      wanted.insert(&method);
      known = true;
    }
    if (!known) throw unknownMethod(word, culprit);
  }
  if (wanted.empty()) throw usageError(culprit, "names no method; see --help");
  std::vector<const Method*> methods;
  for (const Method& method : methodTable())
    if (wanted.count(&method) > 0) methods.push_back(&method);
  return methods;
}

}  // namespace mlsmesh::apps

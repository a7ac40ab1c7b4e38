// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/method_input.h"
#include "compare/stage_clock.h"

#include <pcl/PolygonMesh.h>

#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// One way from a cloud to a mesh.
struct Method {
  std::string name;        ///< as --methods and file names have it
  std::string label;       ///< for people
  std::string maker;       ///< "mlsmesh", "pcl", or "fault"
  std::string parameters;  ///< how it is called, in words; s is the mean spacing
  std::function<pcl::PolygonMesh(const MethodInput&, StageClock&)> run;
};

/// All, in the order of the tables; those of the maker "fault" last.
const std::vector<Method>& methodTable();
/// Null if there is none of that name.
const Method* findMethod(const std::string& name);
/// By names, separated by commas, "all" (but faults) or a maker among them; in the order of the table, each
/// once. Throws AppError (kExitUsage).
std::vector<const Method*> methodsFromText(const std::string& list);

}  // namespace mlsmesh::apps

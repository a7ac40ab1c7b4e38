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
  std::string group;       ///< a word that stands for several: "mlsmesh", "paper", "pcl", or "fault"
  std::string parameters;  ///< how it is called, in words; s is the mean spacing
  std::function<pcl::PolygonMesh(const MethodInput&, StageClock&)> run;
};

/// Whether the user's parameters of reconstruction are its own, before what `parameters` says.
bool takesParameters(const Method& method);

/// All, in the order of the tables; those of the group "fault" last.
const std::vector<Method>& methodTable();
/// Null if there is none of that name.
const Method* findMethod(const std::string& name);
/// By names, separated by commas, or groups, "all" being "mlsmesh" and "pcl"; in the order of the table, each
/// once. Throws AppError (kExitUsage) that names the culprit.
std::vector<const Method*> methodsFromText(const std::string& list, const std::string& culprit);

}  // namespace mlsmesh::apps

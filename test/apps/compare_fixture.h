// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "program.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace mlsmesh::test {

using Json = nlohmann::json;
namespace fs = std::filesystem;

/// Runs mlsmesh_compare to its end.
Outcome runCompare(const std::vector<std::string>& arguments, const std::function<bool()>& prepare = nullptr);
/// Expects an exit code, and one line on stderr that names the program and the culprit.
void expectOneLine(const Outcome& outcome, int exit_code, const std::string& culprit);

/// A scan of a shape of mlsmesh_sample as text.
std::string xyzText(const std::string& shape, std::size_t count);

Json readJson(const fs::path& file);
/// The row of a method on the only cloud.
Json rowOf(const Json& results, const std::string& method);
/// The report of mlsmesh_inspect.
Json inspected(const fs::path& mesh, std::vector<std::string> arguments);

/// Relative to the folder.
std::set<std::string> filesBelow(const fs::path& folder);
std::vector<std::string> linesOf(const std::string& text);
/// How often `part` occurs in the text.
std::size_t countOf(const std::string& text, const std::string& part);
/// "1,234,567".
std::string withCommas(std::size_t number);

}  // namespace mlsmesh::test

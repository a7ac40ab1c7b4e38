// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/results.h"

#include <string>

namespace mlsmesh::apps {

// The files of a comparison but its page: docs/compare.md.

/// Everything, the reports of mlsmesh_inspect among it; indented, with a line end.
std::string resultsJson(const Comparison& comparison);

/// A line for each row, with all figures; a heading first, values with commas or quotes quoted (RFC 4180).
std::string resultsCsv(const Comparison& comparison);

/// The tables for people.
std::string reportMarkdown(const Comparison& comparison);

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "inspect/figures.h"
#include "inspect/inspect_options.h"

#include <string>

namespace mlsmesh::apps {

/// The figures by group, one a line; lengths with their multiples of spacings or diagonals behind them.
std::string reportText(const InspectOptions& options, const FigureTable& table);

/// The JSON document, indented, with a line end: docs/inspect.md.
std::string reportJson(const InspectOptions& options, const Inspection& inspection, const FigureTable& table);

}  // namespace mlsmesh::apps

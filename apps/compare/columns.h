// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/results.h"

#include <functional>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// A column of the tables for people.
struct Column {
  enum class Kind { Count, Seconds, Real };

  std::string heading;
  std::string meaning;  ///< with the unit
  Kind kind = Kind::Real;
  bool zero_is_sound = false;               ///< anything above 0 is a defect
  std::function<double(const Row&)> value;  ///< not a number if it could not be measured

  /// Rounded, for people.
  std::string text(const Row& row) const;
  bool isDefect(const Row& row) const { return zero_is_sound && value(row) > 0; }
};

/// Columns that belong together.
struct ColumnGroup {
  std::string title;
  bool has_all_rows = false;  ///< else those only that have a mesh which was measured
  std::vector<Column> columns;
};

/// Cost, soundness, faithfulness; the last one with distances from the truth if there is one.
std::vector<ColumnGroup> columnGroups(bool with_truth);

/// The rows that a group shows, as numbers from 0.
std::vector<std::size_t> rowsOf(const ColumnGroup& group, const CloudResult& cloud);

/// "done", or what went wrong and why.
std::string resultText(const Row& row);

/// One line for the terminal.
std::string rowLine(const CloudResult& cloud, const Row& row);

/// The number with that many significant digits at most, "–" if it is none.
std::string numberText(double value, int digits);

double toMegabytes(std::uint64_t bytes);

}  // namespace mlsmesh::apps

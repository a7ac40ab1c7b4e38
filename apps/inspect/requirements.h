// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "inspect/figures.h"

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What --require asks of one figure.
struct Requirement {
  enum class Relation { Equal, NotEqual, AtMost, AtLeast, Below, Above };

  std::string text;  ///< as the user wrote it
  std::string name;  ///< of the figure, with or without its group
  Relation relation = Relation::Equal;
  double value = 0;
};

/// "NAME RELATION VALUE", separated by commas; the relation is one of = == != <= >= < >, the value a number,
/// or true, yes, false, no. Throws AppError (kExitUsage) that quotes the part at fault.
std::vector<Requirement> requirementsFromText(const std::string& list);

/// Throws AppError (kExitUsage) if a name is that of no figure of the table, or of several; `every` is the
/// table with all groups, to tell names that need another option from wrong ones.
void checkNames(const std::vector<Requirement>& requirements, const FigureTable& table,
                const FigureTable& every);

/// A sentence for each requirement that does not hold. A figure without a value meets none. Real numbers are
/// equal within 1e-9 of their size.
std::vector<std::string> failures(const std::vector<Requirement>& requirements, const FigureTable& table);

}  // namespace mlsmesh::apps

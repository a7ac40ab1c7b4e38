// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "inspect/inspection.h"

#include <string>
#include <vector>

namespace mlsmesh::apps {

/// One number of the report, as the text, the JSON and --require name it.
struct Figure {
  enum class Kind { Count, Real, Flag };

  std::string group;
  std::string name;
  Kind kind = Kind::Real;
  double value = 0;  ///< not a number if it could not be measured; flags are 0 or 1

  /// "group.name"
  std::string path() const { return group + "." + name; }
  /// The value for people.
  std::string text() const;
};

/// All figures of a report, in order, groups together.
class FigureTable {
 public:
  void add(Figure figure) { figures_.push_back(std::move(figure)); }
  const std::vector<Figure>& figures() const { return figures_; }
  /// The one with that path, or else all with that name.
  std::vector<const Figure*> find(const std::string& name) const;
  /// Paths and names.
  std::vector<std::string> names() const;

 private:
  std::vector<Figure> figures_;
};

/// The one table behind the text, the JSON and --require. Groups of clouds and truths are there if the
/// inspection has them.
FigureTable figuresOf(const Inspection& inspection);

}  // namespace mlsmesh::apps

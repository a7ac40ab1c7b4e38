// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace mlsmesh::apps {

enum class Action {
  ShowCloud,
  ShowClusters,
  ShowRepresentatives,
  ShowMesh,
  ShowBorders,
  ShowDefects,
  ShowDistance,
  Finer,
  Coarser,
  NextFile,
  PreviousFile,
  AllFiles,
  Surface,
  Wireframe,
  Edges,
  Flat,
  LargerDots,
  SmallerDots,
  Labels,
  Fit,
  NextView,
  NextPlace,
  Parallel,
  Picture,
  Help,
  Cancel,
  End
};

/// A key of the window, as X names it, and what it does.
struct Key {
  std::vector<std::string> names;
  Action action = Action::Help;
  std::string help;
};

/// In the order of the help.
const std::vector<Key>& keyTable();

/// Null if the key does nothing.
const Key* findKey(const std::string& name);

/// One line a key: its names, and what it does.
std::string keyHelp();

}  // namespace mlsmesh::apps

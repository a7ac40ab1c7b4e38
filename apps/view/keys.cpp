// SPDX-License-Identifier: BSD-3-Clause
#include "view/keys.h"

#include <algorithm>

namespace mlsmesh::apps {

const std::vector<Key>& keyTable() {
  static const std::vector<Key> kKeys{
      {{"1", "c"}, Action::ShowCloud, "cloud"},
      {{"2", "k"}, Action::ShowClusters, "clusters, neighbours in different colours"},
      {{"3", "n"}, Action::ShowRepresentatives, "representatives with their normals"},
      {{"4", "m"}, Action::ShowMesh, "mesh"},
      {{"5", "b"}, Action::ShowBorders, "borders"},
      {{"6", "d"}, Action::ShowDefects, "defects"},
      {{"7", "t"}, Action::ShowDistance, "distance between mesh and cloud"},
      {{"Up"}, Action::Finer, "finer level"},
      {{"Down"}, Action::Coarser, "coarser level"},
      {{"Right"}, Action::NextFile, "next file alone (with one file: finer level)"},
      {{"Left"}, Action::PreviousFile, "file before it (with one file: coarser level)"},
      {{"a"}, Action::AllFiles, "all files side by side"},
      {{"x"}, Action::NextPlace, "nearer to the next defect or border"},
      {{"r"}, Action::Fit, "all in sight again"},
      {{"v"}, Action::NextView, "next view: front, back, left, right, ..."},
      {{"o"}, Action::Parallel, "parallel or perspective projection"},
      {{"s"}, Action::Surface, "surface"},
      {{"w"}, Action::Wireframe, "wireframe"},
      {{"g"}, Action::Edges, "edges of triangles, on or off"},
      {{"f"}, Action::Flat, "flat or smooth shading"},
      {{"plus"}, Action::LargerDots, "larger dots"},
      {{"minus"}, Action::SmallerDots, "smaller dots"},
      {{"l"}, Action::Labels, "labels on or off"},
      {{"p"}, Action::Picture, "picture of the window, into a PNG file"},
      {{"Escape"}, Action::Cancel, "ends a reconstruction, or a search for defects or distances"},
      {{"h"}, Action::Help, "this list, on or off"},
      {{"q"}, Action::End, "ends the program"}};
  return kKeys;
}

const Key* findKey(const std::string& name) {
  for (const Key& key : keyTable())
    if (std::find(key.names.begin(), key.names.end(), name) != key.names.end()) return &key;
  return nullptr;
}

std::string keyHelp() {
  constexpr std::size_t kColumn = 10;
  std::string text;
  for (const Key& key : keyTable()) {
    std::string names;
    for (const std::string& name : key.names) names += (names.empty() ? "" : ", ") + name;
    names.resize(std::max(kColumn, names.size() + 1), ' ');
    text += "  " + names + key.help + "\n";
  }
  return text;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "patch_shell.h"

#include <unordered_map>

#include "patch_refiner.h"

namespace mlsmesh::core {
namespace {

// The triangles that are connected with this one.
std::vector<Index> componentOf(const HalfEdgeMesh& mesh, Index triangle) {
  std::vector<Index> reached = {triangle};
  std::vector<char> seen(static_cast<std::size_t>(mesh.slotCount()), 0);
  seen[triangle] = 1;
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Index first = 3 * reached[i];
    for (Index h = first; h < first + 3; ++h) {
      if (mesh.isBorder(h) || seen[HalfEdgeMesh::triangleOf(mesh.twin(h))]) continue;
      reached.push_back(HalfEdgeMesh::triangleOf(mesh.twin(h)));
      seen[reached.back()] = 1;
    }
  }
  return reached;
}

// A sheet by itself, turned; the vertices of its rim come first.
class TurnedSheet {
 public:
  TurnedSheet(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const std::vector<Index>& loop)
      : whole_(mesh), points_(points) {
    for (const Index h : loop) add(mesh.origin(h));
    rim_ = loop.size();
    const std::vector<Index> triangles = componentOf(mesh, HalfEdgeMesh::triangleOf(loop.front()));
    std::size_t borders = 0;
    for (const Index t : triangles) {
      for (Index h = 3 * t; h < 3 * t + 3; ++h) borders += mesh.isBorder(h) ? 1 : 0;
      for (const Index v : mesh.corners(t)) add(v);
    }
    const std::size_t edges = (3 * triangles.size() + borders) / 2;
    is_disc_ = triangles.size() > 1 && borders == rim_ && vertex_.size() + triangles.size() == edges + 1;
    if (is_disc_) copy(triangles);
  }

  bool isDisc() const { return is_disc_; }

  void addTo(HalfEdgeMesh& mesh, std::vector<Vec3>& points) {
    for (std::size_t v = rim_; v < own_points_.size(); ++v) {
      const Index own = mesh.addVertex();
      points.push_back(own_points_[v]);
      if (v < vertex_.size()) {
        vertex_[v] = own;
      } else {
        vertex_.push_back(own);
      }
    }
    for (const auto& [a, b, c] : sheet_.triangles()) mesh.addTriangle(vertex_[a], vertex_[b], vertex_[c]);
  }

 private:
  void add(Index vertex) {
    if (number_.emplace(vertex, static_cast<Index>(vertex_.size())).second) vertex_.push_back(vertex);
  }

  void copy(const std::vector<Index>& triangles) {
    sheet_ = HalfEdgeMesh(static_cast<Index>(vertex_.size()));
    for (const Index v : vertex_) own_points_.push_back(points_[v]);
    for (const Index t : triangles) {
      const auto [a, b, c] = whole_.corners(t);
      sheet_.addTriangle(number_.at(a), number_.at(c), number_.at(b));
    }
    std::vector<Index> rim(rim_);
    for (std::size_t i = 0; i < rim_; ++i) rim[i] = static_cast<Index>(i);
    PatchRefiner(sheet_, own_points_, {0, static_cast<Index>(rim_)}, rim).splitChords();
  }

  const HalfEdgeMesh& whole_;
  const std::vector<Vec3>& points_;
  std::vector<Index> vertex_;                // of the whole mesh, by number in the sheet
  std::unordered_map<Index, Index> number_;  // and back
  std::size_t rim_ = 0;
  bool is_disc_ = false;
  HalfEdgeMesh sheet_;
  std::vector<Vec3> own_points_;
};

}  // namespace

bool addShell(HalfEdgeMesh& mesh, std::vector<Vec3>& points, const std::vector<Index>& loop) {
  TurnedSheet sheet(mesh, points, loop);
  if (sheet.isDisc()) sheet.addTo(mesh, points);
  return sheet.isDisc();
}

}  // namespace mlsmesh::core

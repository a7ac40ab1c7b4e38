// SPDX-License-Identifier: BSD-3-Clause
#include "mesh_surgery.h"

#include <algorithm>

namespace mlsmesh::core {
namespace {

constexpr Triangle kNowhere = {0, 0, 0};  // degenerate: the search never finds it
constexpr std::size_t kLeastSpare = 1024;
constexpr std::size_t kSpareShare = 16;  // of the triangles

}  // namespace

MeshSurgery::MeshSurgery(HalfEdgeMesh& mesh, const std::vector<Vec3>& points, const Context& context)
    : mesh_(mesh), points_(points), context_(context) {
  CancelCheck check(context);
  for (Index t = 0; t < mesh.slotCount(); ++t) {
    check();
    if (!mesh.alive(t)) continue;
    for (Index h = 3 * t; h < 3 * t + 3; ++h) border_ += mesh.isBorder(h) ? 1 : 0;
  }
  for (Index v = 0; v < mesh.vertexCount(); ++v) used_ += mesh.isUsed(v) ? 1 : 0;
  renewSearch();
  for (const TrianglePair& pair : search_->all()) notePair(pair);
}

std::vector<Index> MeshSurgery::partnersOf(Index triangle) const {
  std::vector<Index> partners;
  for (const auto* pairs : {&reversed_, &pairs_}) {
    for (auto pair = pairs->lower_bound({triangle, 0}); pair != pairs->end() && (*pair)[0] == triangle;
         ++pair)
      partners.push_back((*pair)[1]);
  }
  return partners;
}

void MeshSurgery::notePair(const TrianglePair& pair) {
  pairs_.insert(pair);
  reversed_.insert({pair[1], pair[0]});
}

// Builds the search anew, with slots to spare.
void MeshSurgery::renewSearch() {
  const std::size_t slots = static_cast<std::size_t>(mesh_.slotCount());
  slots_.assign(slots + std::max(kLeastSpare, slots / kSpareShare), kNowhere);
  free_.clear();
  CancelCheck check(context_);
  for (Index t = 0; t < mesh_.slotCount(); ++t) {
    check();
    if (mesh_.alive(t))
      slots_[t] = mesh_.corners(t);
    else
      free_.push_back(t);
  }
  std::reverse(free_.begin(), free_.end());
  search_ = std::make_unique<SelfIntersections>(points_, slots_, context_, &mesh_);
}

void MeshSurgery::takeOut(Index triangle) {
  const Triangle corners = mesh_.corners(triangle);
  for (Index h = 3 * triangle; h < 3 * triangle + 3; ++h) border_ += mesh_.isBorder(h) ? -1 : 1;
  mesh_.removeTriangle(triangle);
  for (const Index v : corners) used_ -= mesh_.isUsed(v) ? 0 : 1;
  slots_[triangle] = kNowhere;
}

Index MeshSurgery::putIn(const Triangle& corners, Index slot) {
  for (const Index v : corners) used_ += mesh_.isUsed(v) ? 0 : 1;
  if (slot < mesh_.slotCount())
    mesh_.reviveTriangle(slot, corners[0], corners[1], corners[2]);
  else
    slot = mesh_.addTriangle(corners[0], corners[1], corners[2]);
  for (Index h = 3 * slot; h < 3 * slot + 3; ++h) border_ += mesh_.isBorder(h) ? 1 : -1;
  slots_[slot] = corners;
  return slot;
}

Index MeshSurgery::freeSlot() {
  if (!free_.empty()) {
    const Index slot = free_.back();
    free_.pop_back();
    return slot;
  }
  if (static_cast<std::size_t>(mesh_.slotCount()) == slots_.size()) renewSearch();
  return mesh_.slotCount();
}

void MeshSurgery::forgetPairs(const std::vector<Index>& triangles) {
  for (const Index t : triangles) {
    for (const Index partner : partnersOf(t)) {
      pairs_.erase({std::min(t, partner), std::max(t, partner)});
      reversed_.erase({std::max(t, partner), std::min(t, partner)});
    }
  }
}

void MeshSurgery::findPairs(const std::vector<Index>& triangles) {
  search_->update(triangles);
  for (const TrianglePair& pair : search_->involving(triangles)) notePair(pair);
}

void MeshSurgery::remove(const std::vector<Index>& triangles) {
  std::vector<Index> sorted = triangles;
  std::sort(sorted.begin(), sorted.end());
  forgetPairs(sorted);
  for (const Index t : sorted) {
    log_.push_back({t, mesh_.corners(t), false});
    takeOut(t);
    free_.push_back(t);
  }
  search_->update(sorted);
}

bool MeshSurgery::add(const std::vector<Triangle>& triangles) {
  const std::size_t before = mark();
  std::vector<Index> slots;
  bool fits = true;
  for (const Triangle& corners : triangles) {
    fits = mesh_.canAdd(corners[0], corners[1], corners[2]);
    if (!fits) break;
    slots.push_back(putIn(corners, freeSlot()));
    log_.push_back({slots.back(), corners, true});
  }
  findPairs(slots);
  if (!fits) undo(before);
  return fits;
}

void MeshSurgery::undo(std::size_t mark) {
  std::vector<Index> gone, back;
  while (log_.size() > mark) {
    const Step step = log_.back();
    log_.pop_back();
    if (step.added) {
      takeOut(step.triangle);
      free_.push_back(step.triangle);
    } else {
      free_.erase(std::find(free_.rbegin(), free_.rend(), step.triangle).base() - 1);
      putIn(step.corners, step.triangle);
    }
    (step.added ? gone : back).push_back(step.triangle);
  }
  std::sort(gone.begin(), gone.end());
  forgetPairs(gone);
  search_->update(gone);
  back.erase(std::remove_if(back.begin(), back.end(), [&](Index t) { return !mesh_.alive(t); }), back.end());
  findPairs(back);
}

std::vector<Index> MeshSurgery::addedSince(std::size_t mark) const {
  std::vector<Index> added;
  for (std::size_t i = mark; i < log_.size(); ++i) {
    if (log_[i].added && mesh_.alive(log_[i].triangle)) added.push_back(log_[i].triangle);
  }
  std::sort(added.begin(), added.end());
  added.erase(std::unique(added.begin(), added.end()), added.end());
  return added;
}

std::vector<Index> MeshSurgery::openedSince(std::size_t mark) const {
  std::vector<Index> opened;
  for (std::size_t i = mark; i < log_.size(); ++i) {
    if (log_[i].added) continue;
    for (int c = 0; c < 3; ++c) {
      const Index h = mesh_.find(log_[i].corners[(c + 1) % 3], log_[i].corners[c]);
      if (h != kNone && mesh_.isBorder(h)) opened.push_back(h);
    }
  }
  std::sort(opened.begin(), opened.end());
  opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
  return opened;
}

}  // namespace mlsmesh::core

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>
#include <vector>

#include "mlsmesh/core/advancing_front.h"

namespace mlsmesh::core {

/// What every vertex brings along, of one kind. Lists of the caller's are read where they are, until copies
/// of split vertices are appended.
template <typename T>
class VertexList {
 public:
  explicit VertexList(const std::vector<T>* given = nullptr) : given_(given) {}
  VertexList& operator=(std::vector<T> own) {
    own_ = std::move(own);
    given_ = nullptr;
    return *this;
  }

  const std::vector<T>& get() const { return given_ ? *given_ : own_; }
  void appendCopies(const std::vector<Index>& originals) {
    if (originals.empty() || get().empty()) return;
    if (given_) *this = std::vector<T>(*given_);
    for (const Index original : originals) own_.push_back(T(own_[original]));
  }

 private:
  const std::vector<T>* given_;
  std::vector<T> own_;
};

/// What the steps after the front read of every vertex.
struct VertexData {
  VertexList<Vec3> points;
  VertexList<Vec3> normals;
  VertexList<double> cloud_spacing;
  VertexList<Index> cloud_nearest;

  explicit VertexData(const TriangulationInput& input)
      : points(&input.points),
        normals(input.normals),
        cloud_spacing(input.cloud_spacing),
        cloud_nearest(input.cloud_nearest) {}

  void appendCopies(const std::vector<Index>& originals) {
    points.appendCopies(originals);
    normals.appendCopies(originals);
    cloud_spacing.appendCopies(originals);
    cloud_nearest.appendCopies(originals);
  }
};

}  // namespace mlsmesh::core

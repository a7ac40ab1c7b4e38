// SPDX-License-Identifier: BSD-3-Clause
#include "outward.h"

namespace mlsmesh::core {
namespace {

// Triangles, all of them first added to the mean of their corners and then to the volume seen from there.
class Body {
 public:
  void addCorners(const std::vector<Vec3>& points, const Triangle& t) {
    for (const Index v : t) corners_ += points[v];
    ++triangles_;
  }
  void addVolume(const std::vector<Vec3>& points, const Triangle& t) {
    const Vec3 mean = corners_ / (3.0 * static_cast<double>(triangles_));
    volume_ += (points[t[0]] - mean).dot((points[t[1]] - mean).cross(points[t[2]] - mean));
  }
  bool isInsideOut() const { return volume_ < 0; }

 private:
  Vec3 corners_ = Vec3::Zero();
  Index triangles_ = 0;
  double volume_ = 0;
};

}  // namespace

bool isInsideOut(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  Body body;
  for (const Triangle& t : triangles) body.addCorners(points, t);
  for (const Triangle& t : triangles) body.addVolume(points, t);
  return body.isInsideOut();
}

void orientOutward(const std::vector<Vec3>& points, HalfEdgeMesh& mesh, const Context& context) {
  CancelCheck check(context);
  Index count = 0;
  const std::vector<Index> component = mesh.components(&count, context);
  std::vector<Body> bodies(static_cast<std::size_t>(count));
  const auto forEach = [&](const auto& visit) {
    for (Index t = 0; t < mesh.slotCount(); ++t) {
      check();
      if (component[t] != kNone) visit(t, bodies[component[t]]);
    }
  };
  forEach([&](Index t, Body& body) { body.addCorners(points, mesh.corners(t)); });
  forEach([&](Index t, Body& body) { body.addVolume(points, mesh.corners(t)); });
  std::vector<Index> inward;
  forEach([&](Index t, const Body& body) {
    if (body.isInsideOut()) inward.push_back(t);
  });
  mesh.reverse(inward);
}

}  // namespace mlsmesh::core

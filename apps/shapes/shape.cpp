// SPDX-License-Identifier: BSD-3-Clause
#include "shapes/shape.h"

#include "shapes/figure.h"
#include "shapes/round_shapes.h"
#include "shapes/sheets.h"

namespace mlsmesh::shapes {

Vec3 Shape::color(const Vec3& x) const {
  const Eigen::AlignedBox3d bounds = box();
  const Vec3 relative = (x - bounds.min()).cwiseQuotient(bounds.sizes().cwiseMax(1e-12));
  return (0.15 * Vec3::Ones() + 0.8 * relative).cwiseMax(0.0).cwiseMin(1.0);
}

const std::vector<std::string>& shapeNames() {
  static const std::vector<std::string> names{"sphere", "torus", "saddle", "cylinder", "moebius", "figure"};
  return names;
}

std::unique_ptr<Shape> makeShape(const std::string& name) {
  if (name == "sphere") return std::make_unique<Sphere>();
  if (name == "torus") return std::make_unique<Torus>();
  if (name == "saddle") return std::make_unique<Saddle>();
  if (name == "cylinder") return std::make_unique<Cylinder>();
  if (name == "moebius") return std::make_unique<Moebius>();
  if (name == "figure") return std::make_unique<Figure>();
  return nullptr;
}

}  // namespace mlsmesh::shapes

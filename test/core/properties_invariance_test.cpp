// SPDX-License-Identifier: BSD-3-Clause
// What is done to a cloud without changing its surface changes no mesh: to the bit where arithmetic allows
// it, else in topology and within a tolerance.
#include <algorithm>
#include <cmath>

#include "mlsmesh/mesh_distance.h"
#include "properties.h"

namespace mlsmesh::core {
namespace {

using test::Points;

/// Of two meshes of the same surface: in spacings of the cloud of `a`.
struct Tolerance {
  double mean, most;
};

void expectSameSurface(const Reconstruction& a, const Reconstruction& b, const test::Similarity& b_from_a,
                       const Tolerance& tolerance = {0.05, 1.0}) {
  RC_ASSERT(a.mesh.levelCount() == b.mesh.levelCount());
  for (std::size_t level = 0; level < a.reports.size(); ++level) {
    RC_ASSERT(a.reports[level].components == b.reports[level].components);
    RC_ASSERT(a.reports[level].euler == b.reports[level].euler);
    RC_ASSERT(a.reports[level].border_loops == b.reports[level].border_loops);
  }
  Points back;
  const double scale = b_from_a.scale;
  for (const Vec3& p : b.mesh.position) {
    const Vec3 moved = (b.points.world(p) - b_from_a.shift) / scale;
    back.push_back(b_from_a.rotation.transpose() * moved - a.points.origin);
  }
  const std::vector<double> distances =
      distancesFromMesh(back, {a.mesh.position, a.mesh.level_triangles.back()}, test::withThreads(1));
  double sum = 0;
  for (const double d : distances) sum += d;
  RC_ASSERT(sum / static_cast<double>(distances.size()) < tolerance.mean * a.spacing);
  RC_ASSERT(*std::max_element(distances.begin(), distances.end()) < tolerance.most * a.spacing);
}

const test::Similarity kIdentity{1, Eigen::Matrix3d::Identity(), Vec3::Zero()};

RC_GTEST_PROP(Invariance, RigidMotion, ()) {
  const Points cloud = test::drawSurface();
  test::Similarity motion = kIdentity;
  motion.rotation = test::drawRotation();
  motion.shift = Vec3(*rc::gen::inRange(-1000, 1000), *rc::gen::inRange(-1000, 1000), 0.25);
  expectSameSurface(test::meshOf(cloud), test::meshOf(motion(cloud)), motion);
}

RC_GTEST_PROP(Invariance, UniformScale, ()) {
  const Points cloud = test::drawSurface();
  test::Similarity change = kIdentity;
  change.scale = std::pow(10.0, *rc::gen::inRange(-600, 600).as("hundredths of the exponent") * 0.01);
  expectSameSurface(test::meshOf(cloud), test::meshOf(change(cloud)), change);
}

// No length is absolute: powers of two change exponents and hardly a bit.
RC_GTEST_PROP(Invariance, PowersOfTwo, ()) {
  const test::RandomCloud cloud = test::drawAnyCloud(300);
  double largest = 0;
  for (const Vec3& p : cloud.points) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  RC_PRE(largest > 1e-25 && largest < 1e25);  // the origin is rounded to floats, which end there
  const double scale = std::ldexp(1.0, *rc::gen::inRange(-20, 20).as("exponent"));
  Points scaled = cloud.points;
  for (Vec3& p : scaled) p *= scale;
  Reconstruction a, b;
  const auto mesh = [&](const Points& points, Reconstruction& result) {
    return test::codeOf([&] { result = test::meshOf(points, StoredAs::Double, cloud.parameters); });
  };
  const StatusCode code = mesh(cloud.points, a);
  RC_ASSERT(mesh(scaled, b) == code);
  if (code != StatusCode::Ok) return;
  RC_ASSERT(a.mesh.level_triangles == b.mesh.level_triangles);
  constexpr double kRounding = 1e-9;
  for (std::size_t v = 0; v < a.mesh.position.size(); ++v) {
    const double size = a.mesh.position[v].norm() + a.spacing;
    RC_ASSERT((a.mesh.position[v] * scale - b.mesh.position[v]).norm() <= kRounding * size * scale);
  }
}

RC_GTEST_PROP(Invariance, OrderOfThePoints, ()) {
  const test::RandomCloud cloud = test::drawAnyCloud(1000);
  const Points shuffled = test::shuffled(cloud.points, *rc::gen::arbitrary<unsigned>().as("order"));
  Reconstruction a, b;
  const StatusCode code =
      test::codeOf([&] { a = test::meshOf(cloud.points, cloud.stored_as, cloud.parameters); });
  RC_ASSERT(code == test::codeOf([&] { b = test::meshOf(shuffled, cloud.stored_as, cloud.parameters); }));
  test::sameBits(a, b);
}

RC_GTEST_PROP(Invariance, ExactDuplicates, ()) {
  const test::RandomCloud cloud = test::drawAnyCloud(1000);
  Points repeated = cloud.points;
  for (const std::size_t i :
       *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, cloud.points.size())))
    repeated.push_back(cloud.points[i]);
  Reconstruction a, b;
  const StatusCode code =
      test::codeOf([&] { a = test::meshOf(cloud.points, cloud.stored_as, cloud.parameters); });
  RC_ASSERT(code == test::codeOf([&] { b = test::meshOf(repeated, cloud.stored_as, cloud.parameters); }));
  test::sameBits(a, b);
}

}  // namespace
}  // namespace mlsmesh::core

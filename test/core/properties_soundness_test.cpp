// SPDX-License-Identifier: BSD-3-Clause
// No finite input breaks a promise: it ends in sound levels, or in a refusal that it deserves.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include "properties.h"

namespace mlsmesh::core {
namespace {

using test::Points;
using Coordinates = std::vector<std::array<double, 3>>;

template <typename Coordinate>
rc::Gen<Coordinates> cloudsOf(const rc::Gen<Coordinate>& coordinate) {
  return rc::gen::scale(2, rc::gen::container<Coordinates>(
                               rc::gen::container<std::array<double, 3>>(rc::gen::cast<double>(coordinate))));
}

Points pointsOf(const Coordinates& coordinates) {
  Points points;
  for (const auto& [x, y, z] : coordinates) points.emplace_back(x, y, z);
  return points;
}

MultiresolutionParameters drawParameters() {
  MultiresolutionParameters parameters = *rc::gen::element(defaultPreset(), paperPreset(), printedPreset());
  parameters.reduce = *rc::gen::arbitrary<bool>().as("reduce");
  parameters.watertight = *rc::gen::arbitrary<bool>().as("watertight");
  return parameters;
}

void expectSound(const Coordinates& coordinates) {
  const MultiresolutionParameters parameters = drawParameters();
  for (const StoredAs stored_as : {StoredAs::Float, StoredAs::Double}) {
    const std::string fault = test::outcomeOf(pointsOf(coordinates), stored_as, parameters).fault;
    if (!fault.empty()) RC_FAIL(fault);
  }
}

RC_GTEST_PROP(Soundness, PointsOfASmallLattice, ()) {
  expectSound(*cloudsOf(rc::gen::inRange(-2, 3)));
}

RC_GTEST_PROP(Soundness, PointsOfAPlaneLattice, ()) {
  Coordinates coordinates = *cloudsOf(rc::gen::inRange(-5, 6));
  for (auto& point : coordinates) point[2] = 0;
  expectSound(coordinates);
}

RC_GTEST_PROP(Soundness, AnyFloats, ()) {
  const auto bits = rc::gen::arbitrary<std::uint32_t>();
  expectSound(*cloudsOf(rc::gen::map(bits, [](std::uint32_t b) {
    float value;
    std::memcpy(&value, &b, sizeof value);
    return static_cast<double>(value);
  })));
}

RC_GTEST_PROP(Soundness, CoordinatesOfAllSizes, ()) {
  const auto exponent = rc::gen::inRange(-46, 39), sign = rc::gen::element(-1, 1);
  expectSound(*cloudsOf(rc::gen::map(rc::gen::pair(exponent, sign), [](const std::pair<int, int>& drawn) {
    return drawn.second * std::pow(10.0, drawn.first);
  })));
}

RC_GTEST_PROP(Soundness, PointsAFewUnitsInTheLastPlaceApart, ()) {
  const auto steps = rc::gen::inRange(0, 8);
  expectSound(*cloudsOf(rc::gen::map(steps, [](int s) {
    return static_cast<double>(1 + static_cast<float>(s) * std::numeric_limits<float>::epsilon());
  })));
}

RC_GTEST_PROP(Soundness, TwoPlacesFarApart, ()) {
  const auto place = rc::gen::element(0, 1000000), step = rc::gen::inRange(0, 5);
  expectSound(*cloudsOf(rc::gen::map(rc::gen::pair(place, step), [](const std::pair<int, int>& drawn) {
    return drawn.first + drawn.second;
  })));
}

RC_GTEST_PROP(Soundness, CloudsOfAllKinds, ()) {
  const test::RandomCloud cloud = test::drawAnyCloud(1000);
  const std::string fault = test::outcomeOf(cloud.points, cloud.stored_as, cloud.parameters).fault;
  if (!fault.empty()) RC_FAIL(fault);
}

// A level is not touched by what comes after it.
RC_GTEST_PROP(Soundness, LevelsStayAsTheyWere, ()) {
  test::RandomCloud cloud = test::drawAnyCloud(500);
  const int levels = *rc::gen::inRange(0, 3).as("levels");
  Reconstruction fewer, more;
  const auto mesh = [&](int count, Reconstruction& result) {
    cloud.parameters.refinement.levels = count;
    return test::codeOf([&] { result = test::meshOf(cloud.points, cloud.stored_as, cloud.parameters); });
  };
  RC_ASSERT(mesh(levels, fewer) == mesh(levels + 1, more));
  const std::size_t vertices = fewer.mesh.position.size();
  RC_ASSERT(more.mesh.position.size() >= vertices);
  RC_ASSERT(std::equal(fewer.mesh.position.begin(), fewer.mesh.position.end(), more.mesh.position.begin()));
  for (std::size_t level = 0; level < fewer.mesh.level_triangles.size(); ++level) {
    RC_ASSERT(fewer.mesh.level_vertices[level] == more.mesh.level_vertices[level]);
    RC_ASSERT(fewer.mesh.level_triangles[level] == more.mesh.level_triangles[level]);
  }
  for (std::size_t v = vertices; v < more.mesh.position.size(); ++v)
    for (const Index parent : more.mesh.parents[v]) RC_ASSERT(static_cast<std::size_t>(parent) < vertices);
}

}  // namespace
}  // namespace mlsmesh::core

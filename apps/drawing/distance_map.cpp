// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/distance_map.h"

#include "drawing/poly_data.h"
#include "mlsmesh/core/neighbor_search.h"
#include "mlsmesh/core/parallel.h"
#include "mlsmesh/mesh_distance.h"
#include "mlsmesh/mesh_welding.h"

#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {
namespace {

using core::Index;
using core::Vec3;

constexpr int kMostCuts = 64;            // of an edge
constexpr double kMostPoints = 4000000;  // of the cut surface, about
constexpr int kAveraged = 6;             // points of the cloud for the value at a place
constexpr double kUnsupported = 5;       // spacings
constexpr std::size_t kBlock = 1024;

/// Pieces into which each edge of the triangle is cut so that none is longer than `length`.
int cutsOf(const Shape& mesh, const core::Triangle& triangle, double length) {
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    longest = std::max(longest, (mesh.points[triangle[(i + 1) % 3]] - mesh.points[triangle[i]]).norm());
  const double cuts = std::ceil(longest / length);
  return cuts >= 1 ? static_cast<int>(std::min(cuts, static_cast<double>(kMostCuts))) : 1;
}

/// A length of pieces, two spacings or more, that does not give too many of them.
double pieceLength(const Shape& mesh, double spacing) {
  double length = 2 * spacing;
  for (int round = 0; round < 8; ++round) {
    double points = 0;
    for (const core::Triangle& triangle : mesh.triangles) {
      const double cuts = cutsOf(mesh, triangle, length);
      points += (cuts + 1) * (cuts + 2) / 2;
    }
    if (points <= kMostPoints) break;
    length *= 2;
  }
  return length;
}

/// Adds one triangle, cut into cuts^2, whose points are its own.
void appendPieces(const Shape& mesh, const core::Triangle& triangle, int cuts, Shape& surface) {
  const auto first = static_cast<Index>(surface.points.size());
  const auto at = [&](int row, int column) {
    return first + static_cast<Index>(row * (row + 1) / 2 + column);
  };
  for (int row = 0; row <= cuts; ++row) {
    for (int column = 0; column <= row; ++column) {
      const double a = 1 - static_cast<double>(row) / cuts, c = static_cast<double>(column) / cuts;
      const double b = 1 - a - c;
      const auto mean = [&](const std::vector<Vec3>& of) -> Vec3 {
        return a * of[triangle[0]] + b * of[triangle[1]] + c * of[triangle[2]];
      };
      surface.points.push_back(mean(mesh.points));
      if (!mesh.normals.empty()) surface.normals.push_back(mean(mesh.normals));
    }
  }
  for (int row = 0; row < cuts; ++row) {
    for (int column = 0; column <= row; ++column) {
      surface.triangles.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
      if (column < row)
        surface.triangles.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
    }
  }
}

Shape cutFinely(const Shape& mesh, double spacing) {
  const double length = pieceLength(mesh, spacing);
  Shape surface;
  for (const core::Triangle& triangle : mesh.triangles)
    appendPieces(mesh, triangle, cutsOf(mesh, triangle, length), surface);
  return surface;
}

/// What the points of the cloud nearest to a place say.
double valueAt(const Vec3& place, const core::NeighborSearch& search, const std::vector<double>& distance,
               double spacing) {
  std::array<Index, kAveraged> nearest{};
  std::array<double, kAveraged> squared{};
  const int found = search.nearest(place, kAveraged, nearest.data(), squared.data());
  const double gap = std::sqrt(squared[0]);
  if (gap > kUnsupported * spacing) return gap;
  double sum = 0;
  for (int i = 0; i < found; ++i) sum += distance[nearest[i]];
  return sum / found;
}

}  // namespace

DistanceMap mapDistance(const Shape& mesh, const std::vector<Vec3>& cloud, const core::Context& context) {
  constexpr const char* kStage = "distances";
  Progress progress = context.progress;
  progress.enterStage(kStage, 0.1);
  std::vector<Vec3> distinct(cloud);
  std::vector<core::Triangle> none;
  weldVertices(distinct, none);
  const auto search = core::makeKdTree(distinct);
  DistanceMap map;
  map.spacing = core::medianSpacing(distinct, *search, context);
  progress.enterStage(kStage, 0.5);
  const std::vector<double> distance = distancesFromMesh(distinct, {mesh.points, mesh.triangles}, context);
  map.cloud_to_mesh = statisticsOf(distance);
  progress.enterStage(kStage, 1.0);
  map.surface = cutFinely(mesh, map.spacing);
  map.values.resize(map.surface.points.size());
  core::parallelBlocks(context, map.values.size(), kBlock, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      map.values[i] = valueAt(map.surface.points[i], *search, distance, map.spacing);
  });
  return map;
}

vtkSmartPointer<vtkPolyData> toPolyData(const DistanceMap& map, double scale) {
  vtkSmartPointer<vtkPolyData> data = toPolyData(map.surface);
  vtkNew<vtkFloatArray> values;
  values->SetName("Distance");
  values->SetNumberOfTuples(static_cast<vtkIdType>(map.values.size()));
  for (std::size_t i = 0; i < map.values.size(); ++i)
    values->SetValue(static_cast<vtkIdType>(i), static_cast<float>(map.values[i] * scale));
  data->GetPointData()->SetScalars(values);
  return data;
}

}  // namespace mlsmesh::apps

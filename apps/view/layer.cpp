// SPDX-License-Identifier: BSD-3-Clause
#include "view/layer.h"

#include "common/number_text.h"
#include "drawing/layers.h"
#include "drawing/marks.h"
#include "drawing/poly_data.h"

#include <array>
#include <cstdio>

namespace mlsmesh::apps {
namespace {

void addDots(vtkPolyData* cloud, Layer& layer) {
  layer.dots = cloudActor(cloud);
  layer.actors.push_back(layer.dots);
}

void addSurface(const Shape& mesh, const Rgb& color, Layer& layer) {
  layer.surface = surfaceActor(toPolyData(mesh), color);
  layer.actors.push_back(layer.surface);
}

/// A pale one without colours of its own, for marks on it.
void addGround(const Shape& mesh, Layer& layer) {
  Shape plain = mesh;
  plain.colors.clear();
  addSurface(plain, kPaleSurfaceColor, layer);
}

void addMarks(const Marks& marks, Layer& layer) {
  layer.actors.insert(layer.actors.end(), marks.actors.begin(), marks.actors.end());
  layer.legend = marks.legend;
}

std::string inSpacings(const DistanceMap& map) {
  std::array<char, 128> text{};
  const Statistics& of = map.cloud_to_mesh;
  std::snprintf(text.data(), text.size(), "points to mesh, in spacings: mean %.3g, 95 %% %.3g, max %.3g",
                of.mean / map.spacing, of.p95 / map.spacing, of.max / map.spacing);
  return text.data();
}

/// Name of a file, and of the level if it has several.
std::string titleOf(const Subject& subject, int level) {
  std::string title = subject.name();
  if (subject.isCloud()) title += "   level " + std::to_string(level);
  return title;
}

std::string trianglesText(const Subject& subject, int level) {
  return withCommas(subject.level(level).triangles.size()) + " triangles";
}

Layer cloudLayer(Subject& subject) {
  Layer layer;
  addDots(subject.drawnCloud(), layer);
  layer.label = subject.name() + "   " + withCommas(subject.cloud()->points.size()) + " points";
  return layer;
}

Layer clustersLayer(const Subject& subject) {
  Layer layer;
  addDots(withShadingNormals(toPolyData(subject.clusters())), layer);
  layer.label = subject.name() + "   " + withCommas(subject.clusters().points.size()) + " points in " +
                withCommas(subject.representatives().points.size()) + " clusters";
  return layer;
}

Layer representativesLayer(const Subject& subject) {
  constexpr double kLength = 3;  // spacings
  Layer layer;
  Shape ground = subject.clusters();
  ground.colors.assign(ground.points.size(), kPaleSurfaceColor);
  addDots(withShadingNormals(toPolyData(ground)), layer);
  addMarks(normalMarks(subject.representatives(), kLength * subject.spacing()), layer);
  layer.label = subject.name() + "   " + withCommas(subject.representatives().points.size()) +
                " representatives of " + withCommas(ground.points.size()) + " points";
  return layer;
}

Layer meshLayer(const Subject& subject, int level) {
  Layer layer;
  addSurface(subject.level(level), kSurfaceColor, layer);
  layer.label = titleOf(subject, level) + "   " + trianglesText(subject, level);
  return layer;
}

Layer bordersLayer(Subject& subject, int level) {
  Layer layer;
  addGround(subject.level(level), layer);
  const std::vector<BorderEdges>& borders = subject.borders(level);
  addMarks(borderMarks(subject.level(level), borders), layer);
  layer.label = titleOf(subject, level) + "   " + trianglesText(subject, level) + ", " +
                withCommas(borders.size()) + (borders.size() == 1 ? " border" : " borders");
  return layer;
}

Layer defectsLayer(const Subject& subject, int level) {
  Layer layer;
  addGround(subject.level(level), layer);
  if (const MeshDefects* defects = subject.defects(level))
    addMarks(defectMarks(subject.level(level), *defects), layer);
  layer.notice = subject.whyNot(Finding::Defects, level);
  layer.label = titleOf(subject, level) + "   " + trianglesText(subject, level);
  return layer;
}

Layer distanceLayer(const Subject& subject, int level, vtkLookupTable* colors) {
  Layer layer;
  layer.label = titleOf(subject, level) + "   " + trianglesText(subject, level);
  layer.notice = subject.whyNot(Finding::Distances, level);
  if (const DistanceMap* map = subject.distances(level)) {
    layer.actors.push_back(valueActor(toPolyData(*map, 1.0 / map->spacing), colors));
    layer.label += "\n" + inSpacings(*map);
    layer.has_scale = true;
  } else {
    addGround(subject.level(level), layer);
  }
  return layer;
}

Layer plainLayer(Subject& subject, Mode mode, int level, vtkLookupTable* colors) {
  switch (mode) {
    case Mode::Clusters:
      return clustersLayer(subject);
    case Mode::Representatives:
      return representativesLayer(subject);
    case Mode::Mesh:
      return meshLayer(subject, level);
    case Mode::Borders:
      return bordersLayer(subject, level);
    case Mode::Defects:
      return defectsLayer(subject, level);
    case Mode::Distance:
      return distanceLayer(subject, level, colors);
    default:
      return cloudLayer(subject);
  }
}

/// Why a mode that was asked for is not shown.
std::string noticeOf(const Subject& subject, Mode mode) {
  if (subject.isCloud()) return "not reconstructed";
  if (mode == Mode::Clusters || mode == Mode::Representatives)
    return "a mesh has no " + modeNames()[static_cast<std::size_t>(mode) - 1] + ":\nopen its cloud";
  return "no cloud to compare with:\nname it with --cloud FILE";
}

}  // namespace

Mode shownMode(const Subject& subject, Mode mode) {
  if (subject.levelCount() == 0) return Mode::Cloud;
  if (mode == Mode::Auto) return Mode::Mesh;
  const bool has_clusters = subject.isReconstructed();
  if ((mode == Mode::Clusters || mode == Mode::Representatives) && !has_clusters) return Mode::Mesh;
  if ((mode == Mode::Cloud || mode == Mode::Distance) && subject.cloud() == nullptr) return Mode::Mesh;
  return mode;
}

Layer makeLayer(Subject& subject, Mode mode, int level, vtkLookupTable* colors) {
  const Mode shown = shownMode(subject, mode);
  Layer layer = plainLayer(subject, shown, level, colors);
  if (mode != Mode::Auto && shown != mode) layer.notice = noticeOf(subject, mode);
  return layer;
}

}  // namespace mlsmesh::apps

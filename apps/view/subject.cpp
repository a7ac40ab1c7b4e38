// SPDX-License-Identifier: BSD-3-Clause
#include "view/subject.h"

#include "common/app_error.h"
#include "drawing/poly_data.h"
#include "drawing/shape_file.h"
#include "mlsmesh/vertex_cloud.h"
#include "view/view_options.h"

#include <algorithm>
#include <utility>

namespace mlsmesh::apps {

Subject::Subject(const std::filesystem::path& file) : file_(file) {
  ShapeFile read = readShape(file);
  for (const std::string& warning : read.warnings) printWarning(kViewProgram, warning);
  is_cloud_ = !read.shape.isMesh();
  if (is_cloud_) {
    cloud_ = std::make_shared<Shape>(std::move(read.shape));
    fields_ = std::move(read.cloud);
  } else {
    levels_.emplace_back();
    levels_.back().mesh = std::move(read.shape);
  }
}

namespace {

/// Of all vertices of the finest level, which are those of the others as well; none if the cloud has none.
std::vector<Rgb> vertexColors(const core::Reconstruction& reconstruction, const pcl::PCLPointCloud2& cloud,
                              const std::filesystem::path& file) {
  pcl::PCLPointCloud2 vertices;
  makeLevelCloud(reconstruction, reconstruction.mesh.levelCount() - 1, cloud, vertices);
  return cloudShape(vertices, file).colors;
}

}  // namespace

void Subject::setReconstruction(const core::Reconstruction& reconstruction) {
  const std::vector<Rgb> colors = vertexColors(reconstruction, fields_, file_);
  levels_.clear();
  for (core::Index level = 0; level < reconstruction.mesh.levelCount(); ++level) {
    levels_.emplace_back();
    Shape& mesh = levels_.back().mesh;
    mesh = levelShape(reconstruction, level);
    const std::size_t count = std::min(colors.size(), mesh.points.size());
    mesh.colors.assign(colors.begin(), colors.begin() + static_cast<std::ptrdiff_t>(count));
  }
  clusters_ = clustersShape(reconstruction);
  representatives_ = representativesShape(reconstruction);
  spacing_ = reconstruction.spacing;
}

vtkPolyData* Subject::drawnCloud() {
  if (drawn_cloud_ == nullptr) drawn_cloud_ = withShadingNormals(toPolyData(*cloud_));
  return drawn_cloud_;
}

void Subject::useCloud(std::shared_ptr<const Shape> cloud) {
  cloud_ = std::move(cloud);
  drawn_cloud_ = nullptr;
  for (Level& level : levels_) level.distances.reset();
}

const std::vector<BorderEdges>& Subject::borders(int level) {
  Level& of = at(level);
  if (!of.borders)
    of.borders = std::make_unique<std::vector<BorderEdges>>(findBorders(of.mesh.points, of.mesh.triangles));
  return *of.borders;
}

void Subject::setDefects(int level, MeshDefects defects) {
  at(level).defects = std::make_unique<MeshDefects>(std::move(defects));
}

void Subject::setDistances(int level, DistanceMap distances) {
  at(level).distances = std::make_unique<DistanceMap>(std::move(distances));
}

bool Subject::isOpen(Finding finding, int level) const {
  const bool is_found = finding == Finding::Defects ? defects(level) != nullptr : distances(level) != nullptr;
  return !is_found && whyNot(finding, level).empty();
}

const std::string& Subject::whyNot(Finding finding, int level) const {
  return at(level).why_not[static_cast<std::size_t>(finding)];
}

void Subject::giveUp(Finding finding, int level, const std::string& why) {
  at(level).why_not[static_cast<std::size_t>(finding)] = why;
}

bool Subject::openAgain() {
  bool was_given_up = false;
  for (Level& level : levels_) {
    for (std::string& why : level.why_not) {
      was_given_up = was_given_up || !why.empty();
      why.clear();
    }
  }
  return was_given_up;
}

}  // namespace mlsmesh::apps

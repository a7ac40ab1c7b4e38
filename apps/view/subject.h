// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "drawing/distance_map.h"
#include "drawing/shape.h"
#include "mlsmesh/mesh_defects.h"

#include <pcl/PCLPointCloud2.h>

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace mlsmesh::apps {

/// What takes its time to find out about a level.
enum class Finding { Defects, Distances };

/// A file, and what was made of it: a mesh, or a cloud and its reconstruction.
class Subject {
 public:
  /// Reads the file; prints a warning if something is left out. Throws AppError that names it.
  explicit Subject(const std::filesystem::path& file);

  const std::filesystem::path& file() const { return file_; }
  std::string name() const { return file_.filename().string(); }
  bool isCloud() const { return is_cloud_; }
  bool isReconstructed() const { return is_cloud_ && !levels_.empty(); }

  /// Of a cloud, to be reconstructed.
  const pcl::PCLPointCloud2& fields() const { return fields_; }
  /// Of a cloud: takes its levels (in the colours of the cloud), clusters and representatives from the
  /// result. Throws core::Failure.
  void setReconstruction(const core::Reconstruction& reconstruction);

  /// What distances are measured to: of a cloud itself; of a mesh what useCloud() was given, or null.
  const Shape* cloud() const { return cloud_.get(); }
  /// The cloud() ready to be drawn, with normals for its shading; kept.
  vtkPolyData* drawnCloud();
  void useCloud(std::shared_ptr<const Shape> cloud);
  std::shared_ptr<const Shape> sharedCloud() const { return cloud_; }

  /// 1 for a mesh, 0 for a cloud that was not reconstructed.
  int levelCount() const { return static_cast<int>(levels_.size()); }
  const Shape& level(int level) const { return levels_.at(static_cast<std::size_t>(level)).mesh; }
  /// Empty unless reconstructed.
  const Shape& clusters() const { return clusters_; }
  const Shape& representatives() const { return representatives_; }
  double spacing() const { return spacing_; }

  /// Of a level: found when first asked for, then kept. Throws core::Failure.
  const std::vector<BorderEdges>& borders(int level);

  // Of a level: null until they are set. Distances are those from the cloud().
  const MeshDefects* defects(int level) const { return at(level).defects.get(); }
  const DistanceMap* distances(int level) const { return at(level).distances.get(); }
  void setDefects(int level, MeshDefects defects);
  void setDistances(int level, DistanceMap distances);
  /// Neither found nor given up.
  bool isOpen(Finding finding, int level) const;
  /// Why it was given up, for people; empty if it was not.
  const std::string& whyNot(Finding finding, int level) const;
  void giveUp(Finding finding, int level, const std::string& why);
  /// Makes all open that was given up; false if there is nothing of that kind.
  bool openAgain();

 private:
  struct Level {
    Shape mesh;
    std::unique_ptr<MeshDefects> defects;
    std::unique_ptr<std::vector<BorderEdges>> borders;
    std::unique_ptr<DistanceMap> distances;
    std::array<std::string, 2> why_not;  ///< of each finding
  };
  Level& at(int level) { return levels_.at(static_cast<std::size_t>(level)); }
  const Level& at(int level) const { return levels_.at(static_cast<std::size_t>(level)); }

  std::filesystem::path file_;
  bool is_cloud_ = false;
  pcl::PCLPointCloud2 fields_;
  std::shared_ptr<const Shape> cloud_;
  vtkSmartPointer<vtkPolyData> drawn_cloud_;
  std::vector<Level> levels_;
  Shape clusters_;
  Shape representatives_;
  double spacing_ = 0;
};

}  // namespace mlsmesh::apps

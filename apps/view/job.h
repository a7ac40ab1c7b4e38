// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/reconstruction_options.h"
#include "mlsmesh/core/multiresolution.h"
#include "mlsmesh/status.h"
#include "view/subject.h"

#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace mlsmesh::apps {

/// Does work that takes its time, one task after the other, in a thread of its own: reconstructs clouds, or
/// finds what is to be known about levels.
class Job {
 public:
  struct Task {
    Subject* subject = nullptr;
    std::optional<Finding> finding;  ///< none: the reconstruction
    int level = 0;                   ///< of the finding
  };
  /// A task that is done with. What its task did not ask for means nothing, nor does all unless the status is
  /// ok.
  struct Result {
    Task task;
    core::Reconstruction reconstruction;
    MeshDefects defects;
    DistanceMap distances;
    Status status;
    std::vector<std::string> warnings;
  };

  /// Starts at once. The thread reads the subjects' fields(), or the levels and the cloud() of findings: they
  /// must stay as they are, so that one job has tasks of one of both kinds alone.
  Job(std::vector<Task> tasks, const ReconstructionOptions& options);
  /// Cancels what still runs, and waits for it, some milliseconds.
  ~Job();
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  bool reconstructs() const { return !tasks_.front().finding; }
  void cancel();
  /// Of the tasks that are done, one that was not taken yet.
  std::optional<Result> take();
  /// All are done, and taken.
  bool isOver() const;
  /// 0 .. 1 over all tasks.
  double fraction() const;
  /// "bunny.pcd: triangulation".
  std::string stage() const;

 private:
  void run();
  Result resultOf(const Task& task);

  std::vector<Task> tasks_;
  ReconstructionOptions options_;
  Progress progress_;
  mutable std::mutex mutex_;  ///< of what follows
  std::vector<Result> results_;
  std::size_t done_ = 0;
  std::size_t taken_ = 0;
  std::string stage_;
  std::thread thread_;
};

}  // namespace mlsmesh::apps

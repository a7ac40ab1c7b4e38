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

/// Reconstructs clouds one after the other in a thread of its own.
class ReconstructionJob {
 public:
  /// A cloud that is done with.
  struct Result {
    Subject* subject = nullptr;
    core::Reconstruction reconstruction;  ///< means nothing unless the status is ok
    Status status;
    std::vector<std::string> warnings;
  };

  /// Starts at once. The subjects' fields() are read by the thread: they must stay as they are.
  ReconstructionJob(std::vector<Subject*> subjects, const ReconstructionOptions& options);
  /// Cancels what still runs, and waits for it, some milliseconds.
  ~ReconstructionJob();
  ReconstructionJob(const ReconstructionJob&) = delete;
  ReconstructionJob& operator=(const ReconstructionJob&) = delete;

  void cancel();
  /// Of the clouds that are done, one that was not taken yet.
  std::optional<Result> take();
  /// All are done, and taken.
  bool isOver() const;
  /// 0 .. 1 over all clouds.
  double fraction() const;
  /// "bunny.pcd: triangulation".
  std::string stage() const;

 private:
  void run();
  Result reconstruct(Subject& subject);

  std::vector<Subject*> subjects_;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "view/job.h"

#include "common/cloud_reconstruction.h"
#include "mlsmesh/core/failure.h"

#include <utility>

namespace mlsmesh::apps {

Job::Job(std::vector<Task> tasks, const ReconstructionOptions& options)
    : tasks_(std::move(tasks)), options_(options) {
  progress_ = Progress([this](const std::string& stage, double) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stage_ = tasks_[done_].subject->name() + ": " + stage;
  });
  thread_ = std::thread([this] { run(); });
}

Job::~Job() {
  cancel();
  thread_.join();
}

void Job::cancel() {
  progress_.cancel();
}

void Job::run() {
  for (const Task& task : tasks_) {
    Result result = resultOf(task);
    const std::lock_guard<std::mutex> lock(mutex_);
    results_.push_back(std::move(result));
    ++done_;
    progress_.begin();
  }
}

Job::Result Job::resultOf(const Task& task) {
  Result result;
  result.task = task;
  core::Context context;
  context.threads = options_.threads;
  context.progress = progress_;
  const Subject& subject = *task.subject;
  result.status = core::guarded([&] {
    context.checkCancelled();
    if (!task.finding) {
      result.reconstruction = reconstructCloud(subject.fields(), options_.parameters, context);
    } else if (*task.finding == Finding::Defects) {
      // Its loops are not of one length, so that the bar counts whole meshes.
      context.progress.enterStage("defects", 0.0);
      const Shape& mesh = subject.level(task.level);
      result.defects = findDefects(mesh.points, mesh.triangles, context);
    } else {
      result.distances = mapDistance(subject.level(task.level), subject.cloud()->points, context);
    }
  });
  result.warnings = context.warnings;
  return result;
}

std::optional<Job::Result> Job::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_ == results_.size()) return std::nullopt;
  return std::move(results_[taken_++]);
}

bool Job::isOver() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return taken_ == tasks_.size();
}

double Job::fraction() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (done_ == tasks_.size()) return 1.0;
  return (static_cast<double>(done_) + progress_.fraction()) / static_cast<double>(tasks_.size());
}

std::string Job::stage() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stage_;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "view/reconstruction_job.h"

#include "common/cloud_reconstruction.h"
#include "mlsmesh/core/failure.h"

#include <utility>

namespace mlsmesh::apps {

ReconstructionJob::ReconstructionJob(std::vector<Subject*> subjects, const ReconstructionOptions& options)
    : subjects_(std::move(subjects)), options_(options) {
  progress_ = Progress([this](const std::string& stage, double) {
    const std::lock_guard<std::mutex> lock(mutex_);
    stage_ = subjects_[done_]->name() + ": " + stage;
  });
  thread_ = std::thread([this] { run(); });
}

ReconstructionJob::~ReconstructionJob() {
  cancel();
  thread_.join();
}

void ReconstructionJob::cancel() {
  progress_.cancel();
}

void ReconstructionJob::run() {
  for (Subject* subject : subjects_) {
    Result result = reconstruct(*subject);
    const std::lock_guard<std::mutex> lock(mutex_);
    results_.push_back(std::move(result));
    ++done_;
    progress_.begin();
  }
}

ReconstructionJob::Result ReconstructionJob::reconstruct(Subject& subject) {
  Result result;
  result.subject = &subject;
  core::Context context;
  context.threads = options_.threads;
  context.progress = progress_;
  result.status = core::guarded([&] {
    context.checkCancelled();
    result.reconstruction = reconstructCloud(subject.fields(), options_.parameters, context);
  });
  result.warnings = context.warnings;
  return result;
}

std::optional<ReconstructionJob::Result> ReconstructionJob::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (taken_ == results_.size()) return std::nullopt;
  return std::move(results_[taken_++]);
}

bool ReconstructionJob::isOver() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return taken_ == subjects_.size();
}

double ReconstructionJob::fraction() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (done_ == subjects_.size()) return 1.0;
  return (static_cast<double>(done_) + progress_.fraction()) / static_cast<double>(subjects_.size());
}

std::string ReconstructionJob::stage() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return stage_;
}

}  // namespace mlsmesh::apps

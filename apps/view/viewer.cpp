// SPDX-License-Identifier: BSD-3-Clause
#include "view/viewer.h"

#include "common/app_error.h"
#include "drawing/picture.h"
#include "mlsmesh/core/failure.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <utility>

namespace mlsmesh::apps {
namespace {

constexpr std::chrono::milliseconds kProgressPause(200);

/// A name in the current folder that nothing has yet.
std::filesystem::path freePictureName() {
  for (int number = 1;; ++number) {
    const std::filesystem::path name = "mlsmesh_view_" + std::to_string(number) + ".png";
    if (!std::filesystem::exists(name)) return name;
  }
}

/// Reconstructed without being asked: a window on clouds alone.
bool wantsMeshes(const std::vector<Subject>& subjects, const ViewOptions& options) {
  if (options.mode != Mode::Auto) return needsMesh(options.mode);
  return options.screenshot.empty() &&
         std::all_of(subjects.begin(), subjects.end(), [](const Subject& s) { return s.isCloud(); });
}

}  // namespace

Viewer::Viewer(std::vector<Subject>& subjects, const ViewOptions& options, vtkRenderWindow& window)
    : subjects_(subjects), options_(options), scene_(subjects, options, window), script_(options.script) {
  if (wantsMeshes(subjects, options)) reconstruct();
}

void Viewer::press(const std::string& key, const std::string& argument) {
  const Key* known = findKey(key);
  if (known == nullptr) return;
  act(known->action, argument);
  is_changed_ = is_changed_ || known->action != Action::Picture;
}

bool Viewer::takeChange() {
  const bool is_changed = is_changed_;
  is_changed_ = false;
  return is_changed;
}

void Viewer::act(Action action, const std::string& argument) {
  switch (action) {
    case Action::ShowCloud:
      return show(Mode::Cloud);
    case Action::ShowClusters:
      return show(Mode::Clusters);
    case Action::ShowRepresentatives:
      return show(Mode::Representatives);
    case Action::ShowMesh:
      return show(Mode::Mesh);
    case Action::ShowBorders:
      return show(Mode::Borders);
    case Action::ShowDefects:
      return show(Mode::Defects);
    case Action::ShowDistance:
      return show(Mode::Distance);
    case Action::Picture: {
      const std::filesystem::path file =
          argument.empty() ? freePictureName() : std::filesystem::path(argument);
      return writePicture(scene_.window(), file);
    }
    case Action::Cancel:
      if (job_) job_->cancel();
      return;
    case Action::End:
      is_ended_ = true;
      return;
    default:
      return actOnScene(action);
  }
}

void Viewer::actOnScene(Action action) {
  switch (action) {
    case Action::Finer:
      return scene_.stepLevel(1);
    case Action::Coarser:
      return scene_.stepLevel(-1);
    case Action::NextFile:
      return stepFile(1);
    case Action::PreviousFile:
      return stepFile(-1);
    case Action::AllFiles:
      return scene_.showAll();
    case Action::Fit:
      return scene_.fit();
    case Action::NextView:
      return scene_.nextView();
    case Action::Parallel:
      return scene_.toggleParallel();
    case Action::NextPlace:
      scene_.visitNextPlace();
      return;
    case Action::Help:
      return scene_.overlay().toggleHelp();
    default:
      return actOnLook(action);
  }
}

void Viewer::actOnLook(Action action) {
  constexpr double kStep = 1.25;
  constexpr double kMost = 16.0;
  PaneLook& look = scene_.look();
  if (action == Action::Surface) look.surface.wireframe = false;
  if (action == Action::Wireframe) look.surface.wireframe = true;
  if (action == Action::Edges) look.surface.edges = !look.surface.edges;
  if (action == Action::Flat) look.surface.flat = !look.surface.flat;
  if (action == Action::Labels) look.labels = !look.labels;
  if (action == Action::LargerDots) look.dots = std::min(look.dots * kStep, kMost);
  if (action == Action::SmallerDots) look.dots = std::max(look.dots / kStep, 1 / kMost);
  scene_.refresh();
}

void Viewer::show(Mode mode) {
  for (Subject& subject : subjects_)
    if (subject.openAgain()) scene_.renew(subject, "");
  if (needsMesh(mode)) {
    if (!job_)
      reconstruct();
    else
      wants_meshes_ = !job_->reconstructs();
  }
  scene_.setMode(mode);
}

void Viewer::stepFile(int steps) {
  if (subjects_.size() == 1) return scene_.stepLevel(steps);
  const bool is_first_step_back = scene_.shown() < 0 && steps < 0;
  scene_.showOnly(is_first_step_back ? -1 : scene_.shown() + steps);
}

void Viewer::reconstruct() {
  std::vector<Job::Task> tasks;
  for (Subject& subject : subjects_)
    if (subject.isCloud() && !subject.isReconstructed()) tasks.push_back({&subject, std::nullopt, 0});
  if (tasks.empty()) return;
  for (const Job::Task& task : tasks) scene_.renew(*task.subject, "");
  job_ = std::make_unique<Job>(tasks, options_.reconstruction);
  scene_.overlay().showProgress("reconstructing   (Esc ends it)", 0.0);
  scene_.refresh();
}

void Viewer::findWhatIsOpen() {
  const std::vector<Job::Task> tasks = scene_.openFindings();
  if (tasks.empty()) return;
  job_ = std::make_unique<Job>(tasks, options_.reconstruction);
  next_progress_ = std::chrono::steady_clock::now() + kProgressPause;
}

void Viewer::tick() {
  if (job_) followJob();
  if (!job_ && std::exchange(wants_meshes_, false)) reconstruct();
  if (!job_) findWhatIsOpen();
  runScript();
}

void Viewer::followJob() {
  while (std::optional<Job::Result> result = job_->take()) install(*result);
  if (job_->isOver()) {
    job_.reset();
    scene_.overlay().hideProgress();
    scene_.refresh();
    is_changed_ = true;
  } else {
    showProgress();
  }
}

/// Some times a second: drawing a large scene may take longer than a tick.
void Viewer::showProgress() {
  const auto now = std::chrono::steady_clock::now();
  if (now < next_progress_) return;
  next_progress_ = now + kProgressPause;
  scene_.overlay().showProgress(job_->stage() + "   (Esc ends it)", job_->fraction());
  is_changed_ = true;
}

void Viewer::install(Job::Result& result) {
  const Subject& subject = *result.task.subject;
  for (const std::string& warning : result.warnings)
    printWarning(kViewProgram, subject.file().string() + ": " + warning);
  const std::string notice = result.task.finding ? installFinding(result) : installReconstruction(result);
  if (!result.status.ok() && result.status.code != StatusCode::Cancelled) noteFailure(result);
  scene_.renew(subject, notice);
  scene_.refresh();
  is_changed_ = true;
}

std::string Viewer::installReconstruction(Job::Result& result) {
  if (result.status.ok()) {
    result.status = core::guarded([&] { result.task.subject->setReconstruction(result.reconstruction); });
  }
  if (result.status.ok()) return "";
  if (result.status.code == StatusCode::Cancelled)
    return "not reconstructed: cancelled.\nPress m to begin again";
  return "not reconstructed:\n" + result.status.message;
}

/// The subject keeps the reason, because it holds for one level in one mode.
std::string Viewer::installFinding(Job::Result& result) {
  Subject& subject = *result.task.subject;
  const Finding finding = *result.task.finding;
  const bool is_defects = finding == Finding::Defects;
  if (result.status.code == StatusCode::Cancelled) {
    subject.giveUp(finding, result.task.level,
                   is_defects ? "defects not found: cancelled.\nPress d to begin again"
                              : "distances not found: cancelled.\nPress t to begin again");
  } else if (!result.status.ok()) {
    subject.giveUp(finding, result.task.level,
                   (is_defects ? "defects not found:\n" : "distances not found:\n") + result.status.message);
  } else if (is_defects) {
    subject.setDefects(result.task.level, std::move(result.defects));
  } else {
    subject.setDistances(result.task.level, std::move(result.distances));
  }
  return "";
}

void Viewer::noteFailure(const Job::Result& result) {
  const std::string failure = result.task.subject->file().string() + ": " + result.status.message;
  if (failure_.empty()) failure_ = failure;
  if (options_.screenshot.empty()) printWarning(kViewProgram, failure);
}

/// One step at a time, so that each is seen. Steps wait for defects and distances by themselves, but for the
/// key that ends the search.
void Viewer::runScript() {
  if (isScriptDone()) return;
  const ScriptStep& step = script_[next_step_];
  const bool is_wait = step.key == kWaitStep;
  const bool is_held = job_ && (is_wait || !job_->reconstructs());
  if (is_held && (is_wait || findKey(step.key)->action != Action::Cancel)) return;
  if (is_wait) {
    ++next_step_;
    return;
  }
  ++next_step_;
  press(step.key, step.argument);
}

}  // namespace mlsmesh::apps

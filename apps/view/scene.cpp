// SPDX-License-Identifier: BSD-3-Clause
#include "view/scene.h"

#include "common/camera_fit.h"
#include "drawing/marks.h"
#include "drawing/poly_data.h"
#include "mlsmesh/core/failure.h"

#include <vtkBoundingBox.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mlsmesh::apps {
namespace {

constexpr double kRoomForLabels = 0.9;  // of a pane, for what is drawn
constexpr int kFinest = std::numeric_limits<int>::max();

/// Pixels that a pane is wide and high when all are shown.
double paneExtent(const ViewOptions& options) {
  const auto [columns, rows] = paneGrid(options.files.size());
  return std::min(static_cast<double>(options.size[0]) / columns,
                  static_cast<double>(options.size[1]) / rows);
}

/// The next of 1, 2, 5, 10, ... times a power of ten.
double roundedUp(double value) {
  if (!(value > 0)) return 1.0;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

/// Where all of a subject is.
const std::vector<core::Vec3>& extentOf(const Subject& subject) {
  return subject.isCloud() ? subject.cloud()->points : subject.level(0).points;
}

}  // namespace

Scene::Scene(std::vector<Subject>& subjects, const ViewOptions& options, vtkRenderWindow& window)
    : options_(options),
      window_(window),
      subjects_(subjects),
      camera_(vtkSmartPointer<vtkCamera>::New()),
      colors_(valueColors(1.0)),
      overlay_(window, fontSize(std::min(options.size[0], options.size[1]))),
      mode_(options.mode),
      level_(options.level.value_or(kFinest)) {
  look_.surface = options.look;
  look_.borders = options.borders;
  look_.labels = options.labels;
  columns_ = paneGrid(subjects.size())[0];
  rows_ = paneGrid(subjects.size())[1];
  // Behind all panes, for the places that none of them takes.
  const auto backdrop = vtkSmartPointer<vtkRenderer>::New();
  backdrop->SetBackground(1.0, 1.0, 1.0);
  backdrop->InteractiveOff();
  window_.AddRenderer(backdrop);
  for (Subject& subject : subjects)
    panes_.emplace_back(subject, *colors_, paneExtent(options), *camera_, window_);
  on_render_->SetClientData(this);
  on_render_->SetCallback(onRender);
  window_.AddObserver(vtkCommand::StartEvent, on_render_);
  placePanes();
  fit();
  refresh();
}

Scene::~Scene() {
  window_.RemoveObserver(on_render_);
}

/// The camera moves for one pane, but all are to be within its range.
void Scene::onRender(vtkObject*, unsigned long, void* scene, void*) {
  static_cast<Scene*>(scene)->resetClipping();
}

void Scene::resetClipping() {
  vtkBoundingBox box;
  for (const Pane& pane : panes_) {
    std::array<double, 6> bounds{};
    pane.renderer().ComputeVisiblePropBounds(bounds.data());
    if (bounds[0] <= bounds[1]) box.AddBounds(bounds.data());
  }
  if (!box.IsValid()) return;
  std::array<double, 6> bounds{};
  box.GetBounds(bounds.data());
  panes_.front().renderer().ResetCameraClippingRange(bounds.data());
}

void Scene::setMode(Mode mode) {
  const bool is_fitted = core::Vec3(camera_->GetPosition()) == fitted_position_;
  mode_ = mode;
  visited_ = 0;
  if (is_fitted)
    fit();
  else
    makeRoomForScale();
  refresh();
}

double Scene::makeRoomForScale() {
  constexpr double kShare = 0.15;  // of a pane
  const double share = mode_ == Mode::Distance ? kShare : 0.0;
  camera_->SetWindowCenter(share, 0.0);
  return 1.0 - share;
}

int Scene::levelCount() const {
  int count = 0;
  for (const Subject& subject : subjects_) count = std::max(count, subject.levelCount());
  return count;
}

void Scene::stepLevel(int steps) {
  const int finest = std::max(0, levelCount() - 1);
  level_ = std::clamp(std::min(level_, finest) + steps, 0, finest);
  visited_ = 0;
  refresh();
}

void Scene::refresh() {
  setScale();
  for (Pane& pane : panes_) pane.show(mode_, level_, look_);
}

int Scene::levelOf(const Subject& subject) const {
  return std::clamp(level_, 0, std::max(0, subject.levelCount() - 1));
}

std::vector<Job::Task> Scene::openFindings() const {
  std::vector<Job::Task> tasks;
  for (Subject& subject : subjects_) {
    const Mode shown = shownMode(subject, mode_);
    if (shown != Mode::Defects && shown != Mode::Distance) continue;
    const Finding finding = shown == Mode::Defects ? Finding::Defects : Finding::Distances;
    if (subject.isOpen(finding, levelOf(subject))) tasks.push_back({&subject, finding, levelOf(subject)});
  }
  return tasks;
}

void Scene::renew(const Subject& subject, const std::string& notice) {
  for (Pane& pane : panes_) {
    if (&pane.subject() != &subject) continue;
    pane.forget();
    pane.setNotice(notice);
  }
}

/// One scale for all panes: up to what 99 % of the points of each cloud are within, in its spacings.
void Scene::setScale() {
  if (mode_ != Mode::Distance) return;
  double highest = options_.scale;
  for (const Subject& subject : subjects_) {
    if (options_.scale > 0 || shownMode(subject, mode_) != Mode::Distance) continue;
    if (const DistanceMap* map = subject.distances(levelOf(subject)))
      highest = std::max(highest, roundedUp(map->cloud_to_mesh.p99 / map->spacing));
  }
  if (highest > 0) colors_->SetTableRange(0.0, highest);
}

void Scene::placePanes() {
  for (int i = 0; i < paneCount(); ++i) {
    std::array<double, 4> place{};
    if (shown_ < 0) {
      const double column = i % columns_, row = rows_ - 1 - i / columns_;
      place = {column / columns_, row / rows_, (column + 1) / columns_, (row + 1) / rows_};
    } else if (i == shown_) {
      place = {0.0, 0.0, 1.0, 1.0};
    }
    panes_[static_cast<std::size_t>(i)].setPlace(place);
  }
}

void Scene::showAll() {
  shown_ = -1;
  placePanes();
}

void Scene::showOnly(int pane) {
  shown_ = (pane % paneCount() + paneCount()) % paneCount();
  placePanes();
}

void Scene::fit() {
  std::vector<vtkSmartPointer<vtkPolyData>> kept;
  std::vector<vtkPoints*> scene;
  for (const Subject& subject : subjects_) {
    kept.push_back(pointsOf(extentOf(subject)));
    scene.push_back(kept.back()->GetPoints());
  }
  const double aspect =
      (static_cast<double>(options_.size[0]) / columns_) / (static_cast<double>(options_.size[1]) / rows_);
  const double room = makeRoomForScale() * (look_.labels ? kRoomForLabels : 1.0);
  fitCamera(scene, options_.viewpoint, aspect, room * options_.zoom, *camera_);
  fitted_position_ = core::Vec3(camera_->GetPosition());
  camera_->SetParallelScale(camera_->GetDistance() *
                            std::tan(0.5 * camera_->GetViewAngle() * 3.141592653589793 / 180.0));
}

void Scene::nextView() {
  static const std::array<const char*, 7> kViews{"front", "back", "left", "right", "top", "bottom", "iso"};
  const auto* now = std::find(kViews.begin(), kViews.end(), options_.view);
  options_.view = now == kViews.end() || now + 1 == kViews.end() ? kViews.front() : *(now + 1);
  options_.viewpoint = namedViewpoint(options_.view, options_.up);
  fit();
}

void Scene::toggleParallel() {
  camera_->SetParallelProjection(camera_->GetParallelProjection() == 0);
}

std::vector<core::Vec3> Scene::placesToVisit() const {
  std::vector<core::Vec3> places;
  for (std::size_t i = 0; i < panes_.size(); ++i) {
    Subject& subject = panes_[i].subject();
    if (subject.levelCount() == 0 || (shown_ >= 0 && static_cast<int>(i) != shown_)) continue;
    const int level = levelOf(subject);
    std::vector<core::Vec3> found;
    if (mode_ == Mode::Borders)
      found = placesOf(subject.level(level), subject.borders(level));
    else if (const MeshDefects* defects = subject.defects(level))
      found = placesOf(subject.level(level), *defects);
    places.insert(places.end(), found.begin(), found.end());
  }
  return places;
}

bool Scene::visitNextPlace() {
  constexpr double kNearness = 8;  // times nearer than where all is in sight
  if (mode_ != Mode::Borders && mode_ != Mode::Defects) return false;
  std::vector<core::Vec3> places;
  core::guarded([&] { places = placesToVisit(); });
  if (places.empty()) return false;
  const core::Vec3 place = places[visited_++ % places.size()];
  const core::Vec3 direction = core::Vec3(camera_->GetDirectionOfProjection());
  fit();
  const core::Vec3 position = place - camera_->GetDistance() / kNearness * direction;
  camera_->SetFocalPoint(place.data());
  camera_->SetPosition(position.data());
  camera_->SetParallelScale(camera_->GetParallelScale() / kNearness);
  return true;
}

}  // namespace mlsmesh::apps

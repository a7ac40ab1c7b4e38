// SPDX-License-Identifier: BSD-3-Clause
#include "view/pane.h"

#include "drawing/marks.h"
#include "mlsmesh/core/failure.h"

#include <vtkDataSet.h>
#include <vtkMapper.h>
#include <vtkProperty.h>

#include <algorithm>

namespace mlsmesh::apps {

Pane::Pane(Subject& subject, vtkLookupTable& colors, double extent, vtkCamera& camera,
           vtkRenderWindow& window)
    : subject_(&subject), colors_(&colors), extent_(extent), renderer_(vtkSmartPointer<vtkRenderer>::New()) {
  setUpRenderer(*renderer_);
  renderer_->SetActiveCamera(&camera);
  window.AddRenderer(renderer_);
}

void Pane::forget() {
  layers_.clear();
  notice_.clear();
}

void Pane::setPlace(const std::array<double, 4>& place) {
  const bool is_drawn = place[2] > place[0];
  renderer_->SetDraw(is_drawn);
  // A renderer needs a place even if it draws nothing.
  if (is_drawn)
    renderer_->SetViewport(place[0], place[1], place[2], place[3]);
  else
    renderer_->SetViewport(0.0, 0.0, 0.001, 0.001);
}

const Layer& Pane::layer(Mode mode, int level) {
  const auto key = std::make_pair(mode, level);
  const auto found = layers_.find(key);
  if (found != layers_.end()) return found->second;
  Layer made;
  const Status status = core::guarded([&] { made = makeLayer(*subject_, mode, level, colors_); });
  if (!status.ok()) made.notice = status.message;
  return layers_.emplace(key, std::move(made)).first->second;
}

void Pane::show(Mode mode, int level, const PaneLook& look) {
  const int nearest = std::clamp(level, 0, std::max(0, subject_->levelCount() - 1));
  const Layer& shown = layer(mode, nearest);
  renderer_->RemoveAllViewProps();
  for (const auto& actor : shown.actors) renderer_->AddActor(actor);
  if (look.borders && shownMode(*subject_, mode) == Mode::Mesh) {
    for (const auto& actor : borderMarks(subject_->level(nearest), subject_->borders(nearest)).actors)
      renderer_->AddActor(actor);
  }
  applyLook(shown, look);
  addNotes(shown, notice_.empty() || mode == Mode::Cloud ? shown.notice : notice_, look);
}

void Pane::applyLook(const Layer& layer, const PaneLook& look) {
  if (layer.surface) setLook(look.surface, *layer.surface);
  if (!layer.dots) return;
  const double size =
      dotSize(static_cast<double>(layer.dots->GetMapper()->GetInput()->GetNumberOfPoints()), extent_);
  layer.dots->GetProperty()->SetPointSize(static_cast<float>(size * look.dots));
}

void Pane::addNotes(const Layer& layer, const std::string& notice_text, const PaneLook& look) {
  const int font = fontSize(extent_);
  if (!notice_text.empty()) renderer_->AddActor2D(notice(notice_text, font));
  if (layer.has_scale) renderer_->AddActor2D(scaleBar(colors_, "spacings", extent_));
  if (!look.labels) return;
  renderer_->AddActor2D(label(layer.label, font));
  for (const auto& actor : legend(layer.legend, font)) renderer_->AddActor2D(actor);
}

}  // namespace mlsmesh::apps

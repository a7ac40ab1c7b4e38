// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/notes.h"

#include <vtkCoordinate.h>
#include <vtkNew.h>
#include <vtkTextProperty.h>

#include <algorithm>

namespace mlsmesh::apps {
namespace {

vtkSmartPointer<vtkTextActor> textActor(const std::string& text, int font_size) {
  auto actor = vtkSmartPointer<vtkTextActor>::New();
  actor->SetInput(text.c_str());
  actor->GetTextProperty()->SetColor(unitRgb(kTextColor).data());
  actor->GetTextProperty()->SetFontSize(font_size);
  return actor;
}

/// Puts the actor some pixels right of and above a place of the pane, whose corners are (0, 0) and (1, 1).
void place(vtkTextActor& actor, double x, double y, double right, double above) {
  vtkNew<vtkCoordinate> anchor;
  anchor->SetCoordinateSystemToNormalizedViewport();
  anchor->SetValue(x, y);
  vtkCoordinate& position = *actor.GetPositionCoordinate();
  position.SetCoordinateSystemToViewport();
  position.SetReferenceCoordinate(anchor);
  position.SetValue(right, above);
}

void setGround(vtkTextProperty& look) {
  look.SetBackgroundColor(1.0, 1.0, 1.0);
  look.SetBackgroundOpacity(0.9);
}

}  // namespace

int fontSize(double pixels) {
  return std::clamp(static_cast<int>(pixels / 38.0), 9, 26);
}

vtkSmartPointer<vtkTextActor> label(const std::string& text, int font_size) {
  vtkSmartPointer<vtkTextActor> actor = textActor(text, font_size);
  actor->GetTextProperty()->SetBackgroundColor(1.0, 1.0, 1.0);
  actor->GetTextProperty()->SetBackgroundOpacity(0.85);
  place(*actor, 0.0, 0.0, font_size, 0.7 * font_size);
  return actor;
}

vtkSmartPointer<vtkTextActor> notice(const std::string& text, int font_size) {
  vtkSmartPointer<vtkTextActor> actor = textActor(text, font_size);
  setGround(*actor->GetTextProperty());
  actor->GetTextProperty()->SetJustificationToCentered();
  actor->GetTextProperty()->SetVerticalJustificationToCentered();
  place(*actor, 0.5, 0.5, 0.0, 0.0);
  return actor;
}

vtkSmartPointer<vtkTextActor> table(const std::string& text, int font_size) {
  vtkSmartPointer<vtkTextActor> actor = textActor(text, font_size);
  setGround(*actor->GetTextProperty());
  actor->GetTextProperty()->SetFontFamilyToCourier();
  actor->GetTextProperty()->SetVerticalJustificationToTop();
  place(*actor, 0.0, 1.0, font_size, -font_size);
  return actor;
}

std::vector<vtkSmartPointer<vtkTextActor>> legend(const std::vector<LegendEntry>& entries, int font_size) {
  std::vector<vtkSmartPointer<vtkTextActor>> actors;
  double below = 0.0;
  for (const LegendEntry& entry : entries) {
    below += 1.7 * font_size;
    vtkSmartPointer<vtkTextActor> square = textActor("MM", font_size);
    vtkTextProperty& look = *square->GetTextProperty();
    look.SetColor(unitRgb(entry.color).data());
    look.SetBackgroundColor(unitRgb(entry.color).data());
    look.SetBackgroundOpacity(1.0);
    place(*square, 0.0, 1.0, font_size, -below);
    vtkSmartPointer<vtkTextActor> text = textActor(entry.text, font_size);
    text->GetTextProperty()->SetBackgroundColor(1.0, 1.0, 1.0);
    text->GetTextProperty()->SetBackgroundOpacity(0.85);
    place(*text, 0.0, 1.0, 3.5 * font_size, -below);
    actors.push_back(square);
    actors.push_back(text);
  }
  return actors;
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "drawing/layers.h"

#include <vtkLightKit.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace mlsmesh::apps {
namespace {

vtkSmartPointer<vtkActor> shadedActor(vtkPolyDataMapper* mapper, const Rgb& color) {
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  vtkProperty& look = *actor->GetProperty();
  look.SetColor(unitRgb(color).data());
  look.SetSpecular(0.2);
  look.SetSpecularPower(25.0);
  look.SetEdgeColor(unitRgb(kEdgeColor).data());
  look.SetInterpolationToPhong();
  return actor;
}

void setText(vtkTextProperty& text, int size) {
  text.SetColor(unitRgb(kTextColor).data());
  text.SetFontSize(size);
  text.BoldOff();
  text.ItalicOff();
  text.ShadowOff();
}

}  // namespace

void setUpRenderer(vtkRenderer& renderer) {
  renderer.SetBackground(1.0, 1.0, 1.0);
  renderer.SetBackground2(0.88, 0.91, 0.95);
  renderer.GradientBackgroundOn();
  vtkNew<vtkLightKit> lights;
  lights->SetKeyLightIntensity(1.0);
  lights->SetKeyLightWarmth(0.52);
  lights->AddLightsToRenderer(&renderer);
}

vtkSmartPointer<vtkActor> surfaceActor(vtkPolyData* mesh, const Rgb& color) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  return shadedActor(mapper, color);
}

void setLook(const SurfaceLook& look, vtkActor& surface) {
  vtkProperty& property = *surface.GetProperty();
  if (look.flat)
    property.SetInterpolationToFlat();
  else
    property.SetInterpolationToPhong();
  property.SetEdgeVisibility(look.edges);
  if (look.wireframe)
    property.SetRepresentationToWireframe();
  else
    property.SetRepresentationToSurface();
}

vtkSmartPointer<vtkActor> valueActor(vtkPolyData* mesh, vtkLookupTable* colors) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(mesh);
  mapper->SetLookupTable(colors);
  mapper->UseLookupTableScalarRangeOn();
  mapper->InterpolateScalarsBeforeMappingOn();
  vtkSmartPointer<vtkActor> actor = shadedActor(mapper, kSurfaceColor);
  // Little shading, for the colours to be read.
  vtkProperty& look = *actor->GetProperty();
  look.SetSpecular(0.0);
  look.SetAmbient(0.35);
  look.SetDiffuse(0.65);
  return actor;
}

vtkSmartPointer<vtkScalarBarActor> scaleBar(vtkLookupTable* colors, const std::string& title, double pixels) {
  constexpr int kLabels = 5;
  constexpr double kLetters = 5.5;  // wide
  auto bar = vtkSmartPointer<vtkScalarBarActor>::New();
  bar->SetLookupTable(colors);
  bar->SetTitle(title.c_str());
  bar->SetNumberOfLabels(kLabels);
  bar->SetLabelFormat("%.3g");
  bar->UnconstrainedFontSizeOn();
  const int size = std::clamp(static_cast<int>(pixels / 40.0), 9, 24);
  setText(*bar->GetLabelTextProperty(), size);
  setText(*bar->GetTitleTextProperty(), size);
  bar->SetVerticalTitleSeparation(size);
  const double width = std::clamp(kLetters * size / pixels, 0.1, 0.4);
  bar->SetWidth(width);
  bar->SetHeight(0.6);
  bar->SetBarRatio(0.22);
  bar->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  bar->SetPosition(0.99 - width, 0.2);
  return bar;
}

vtkSmartPointer<vtkActor> cloudActor(vtkPolyData* cloud, const Rgb& color) {
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(cloud);
  vtkSmartPointer<vtkActor> actor = shadedActor(mapper, color);
  if (cloud->GetPointData()->GetNormals() == nullptr) return actor;
  // Their normals may have no side, so they are turned towards the viewer.
  actor->GetShaderProperty()->AddFragmentShaderReplacement(
      "//VTK::Normal::Impl", true,
      "//VTK::Normal::Impl\n  if (normalVCVSOutput.z < 0.0) normalVCVSOutput = -normalVCVSOutput;\n", false);
  return actor;
}

float dotSize(double points, double pixels) {
  constexpr double kDotShare = 1.5;
  return static_cast<float>(std::clamp(kDotShare * pixels / std::sqrt(std::max(points, 1.0)), 2.0, 12.0));
}

}  // namespace mlsmesh::apps

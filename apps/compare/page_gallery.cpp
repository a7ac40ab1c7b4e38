// SPDX-License-Identifier: BSD-3-Clause
#include "compare/page_gallery.h"

#include "common/file_bytes.h"
#include "common/number_text.h"
#include "compare/columns.h"
#include "compare/mark_colors.h"
#include "compare/page_markup.h"
#include "compare/plots.h"

#include <vtkBase64Utilities.h>
#include <vtkLookupTable.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cmath>

namespace mlsmesh::apps {
namespace {

std::string dataUri(const std::filesystem::path& jpeg) {
  const std::string bytes = readBytes(jpeg);
  std::string text(bytes.size() / 3 * 4 + 8, '\0');
  const auto length =
      vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                                 reinterpret_cast<unsigned char*>(text.data()), 0);
  text.resize(length);
  return "data:image/jpeg;base64," + text;
}

std::string colorText(const Rgb& color) {
  return "rgb(" + std::to_string(color[0]) + "," + std::to_string(color[1]) + "," + std::to_string(color[2]) +
         ")";
}

std::string figure(const std::string& caption, const std::filesystem::path& picture, const std::string& alt,
                   const std::string& otherwise) {
  const std::string image =
      picture.empty()
          ? element("div", otherwise, "class=\"none\"")
          : element("div",
                    "<img loading=\"lazy\" alt=\"" + escaped(alt) + "\" src=\"" + dataUri(picture) + "\">",
                    "class=\"picture\"");
  return element("figure", image + element("figcaption", caption)) + "\n";
}

std::string countText(const Row& row, const char* name, const char* one, const char* many) {
  const double count = row.figure("topology", name);
  return count > 0 ? wholeText(count) + kNoBreak + (count == 1 ? one : many) : std::string();
}

/// What there is to see in the picture of a surface.
std::string surfaceText(const Row& row) {
  std::string text;
  for (const std::string& part :
       {countText(row, "triangles", "triangle", "triangles"),
        countText(row, "border_loops", "border loop", "border loops"),
        countText(row, "nonmanifold_edges", "non-manifold edge", "non-manifold edges"),
        countText(row, "orientation_conflicts", "misoriented edge", "misoriented edges"),
        countText(row, "self_intersections", "self-intersection", "self-intersections")})
    if (!part.empty()) text += (text.empty() ? "" : ", ") + part;
  return text;
}

std::string distanceText(const Row& row, const std::string& group) {
  const auto named = [&](const std::string& name, const char* figure) {
    return name + kNoBreak + readableText(row.figure(group, figure));
  };
  return named("mean", "mean_spacings") + ", " + named(std::string("95") + kNoBreak + "%", "p95_spacings") +
         ", " + named("max", "max_spacings") + kNoBreak + "spacings";
}

using PictureOf = std::filesystem::path Pictures::*;

/// Of every method; of those without a mesh, beside the surfaces only, why.
std::string methodFigures(const CloudResult& cloud, PictureOf picture, const std::string& what,
                          std::string (*text)(const Row&)) {
  std::string figures;
  for (std::size_t i = 0; i < cloud.rows.size(); ++i) {
    const Row& row = cloud.rows[i];
    if (row.mesh_file.empty() && picture != &Pictures::surface) continue;  // said once
    const std::string caption =
        numbered(i, row.method->label) + element("small", row.report.is_object() ? escaped(text(row)) : "");
    figures += figure(caption, row.pictures.*picture, what + " of " + row.method->label,
                      row.mesh_file.empty() ? escaped(resultText(row)) : "no picture");
  }
  return figures;
}

std::string swatch(const std::string& shapes, const std::string& text) {
  return element("li", "<svg class=\"swatch\" viewBox=\"0 0 34 16\" aria-hidden=\"true\">" + shapes +
                           "</svg>" + escaped(text));
}

std::string lineSwatch(const Rgb& color, double width, const std::string& text) {
  return swatch("<rect width=\"34\" height=\"16\" fill=\"" + colorText(MarkColors::kFront) +
                    "\"/><path stroke=\"" + colorText(color) + "\" stroke-width=\"" + numberText(width, 3) +
                    "\" d=\"M0 8H34\"/>",
                text);
}

std::string areaSwatch(const Rgb& color, const std::string& text) {
  return swatch("<rect width=\"34\" height=\"16\" fill=\"" + colorText(color) + "\"/>", text);
}

std::string markLegend() {
  return element("ul",
                 areaSwatch(MarkColors::kFront, "front of a triangle") +
                     areaSwatch(MarkColors::kBack, "its back") +
                     lineSwatch(MarkColors::kBorder, 3, "border") +
                     lineSwatch(MarkColors::kNonManifold, 6, "non-manifold edge (widest)") +
                     lineSwatch(MarkColors::kMisoriented, 1.2, "misoriented edge (thinnest)") +
                     areaSwatch(MarkColors::kIntersecting, "triangles that meet others"),
                 "class=\"legend\"");
}

/// Of a place 0 .. 1 on the scale of the maps.
std::string scaleColor(double place) {
  static const vtkSmartPointer<vtkLookupTable> colors = valueColors(1);
  std::array<double, 3> color{};
  colors->GetColor(place, color.data());
  const auto byte = [](double share) { return static_cast<std::uint8_t>(std::lround(255 * share)); };
  return colorText({byte(color[0]), byte(color[1]), byte(color[2])});
}

std::string scaleLegend(double end) {
  constexpr int kSteps = 40;
  constexpr double kScaleWidth = 400;
  std::string svg =
      "<svg class=\"scale\" viewBox=\"-8 0 440 38\" role=\"img\" aria-label=\"scale from 0 to " +
      numberText(end, 3) + " spacings\">";
  for (int i = 0; i < kSteps; ++i) {
    svg += "<rect x=\"" + numberText(i * kScaleWidth / kSteps, 6) + "\" width=\"" +
           numberText(kScaleWidth / kSteps + 0.5, 6) + "\" height=\"16\" fill=\"" +
           scaleColor((i + 0.5) / kSteps) + "\"/>";
  }
  for (int i = 0; i <= 4; ++i) {
    const std::string text = numberText(end * i / 4, 3) + (i == 4 ? " and more" : i == 0 ? " spacings" : "");
    const char* anchor = i == 4 ? "end" : i == 0 ? "start" : "middle";
    svg += "<text y=\"33\" x=\"" + numberText(i == 4 ? kScaleWidth + 30 : i * kScaleWidth / 4, 6) +
           "\" text-anchor=\"" + anchor + "\">" + text + "</text>";
  }
  return svg + "</svg>";
}

std::string note(const std::string& text) {
  return element("p", text, "class=\"note\"");
}

std::string surfaceNote() {
  return note(
      "All are seen by the camera of the cloud. An open surface may show its back, which is darker, without "
      "being at fault. What a method adds far from the points, as Poisson&rsquo;s may, runs out of the "
      "picture.");
}

/// Distance from the points is an error on clean clouds only.
std::string missNote(bool has_truth) {
  const std::string judge =
      has_truth ? "the distances from the true surface, under Faithfulness, decide which mesh is better."
                : "only distances from a true surface (<code>--truth</code>) can tell which mesh is better.";
  return note(
      "Dark where the mesh is far from points. If the cloud is clean, the mesh misses them there; if it is "
      "noisy, a mesh that leaves the noise out must be dark, and " +
      judge);
}

std::string inventionNote() {
  return note(
      "Measured from its centre to the nearest point. Dark where there are no points: surface that was "
      "invented.");
}

}  // namespace

std::string galleries(const CloudResult& cloud) {
  if (cloud.cloud_picture.empty()) return note("No pictures were made.");
  std::string originals =
      figure("The cloud" + element("small", withCommas(cloud.points) + kNoBreak + "points"),
             cloud.cloud_picture, "the cloud " + cloud.name, "");
  if (!cloud.truth_picture.empty())
    originals += figure("The true surface" + element("small", escaped(cloud.truth.filename().string())),
                        cloud.truth_picture, "the true surface", "");
  const auto gallery = [](const std::string& title, const std::string& preface, const std::string& figures) {
    return element("h3", title) + preface + element("div", figures, "class=\"gallery\"") + "\n";
  };
  return gallery("Surfaces", surfaceNote() + markLegend(),
                 originals + methodFigures(cloud, &Pictures::surface, "surface", surfaceText)) +
         gallery("How far each point of the cloud is from the mesh",
                 missNote(!cloud.truth.empty()) + scaleLegend(kCloudToMeshEnd),
                 methodFigures(cloud, &Pictures::cloud_to_mesh, "distances of the points from the mesh",
                               [](const Row& row) { return distanceText(row, "cloud_to_mesh"); })) +
         gallery("How far each triangle of the mesh is from the cloud",
                 inventionNote() + scaleLegend(kMeshToCloudEnd),
                 methodFigures(cloud, &Pictures::mesh_to_cloud, "distances of the mesh from the points",
                               [](const Row& row) { return distanceText(row, "mesh_to_cloud"); }));
}

}  // namespace mlsmesh::apps

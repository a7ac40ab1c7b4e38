// SPDX-License-Identifier: BSD-3-Clause
#include "common/ply_mesh.h"

#include "common/app_error.h"
#include "common/header_check.h"
#include "common/ply_scalars.h"

#include <pcl/io/ply/ply_parser.h>

#include <array>
#include <functional>
#include <string>
#include <tuple>
#include <utility>

namespace mlsmesh::apps {

namespace {

namespace ply = pcl::io::ply;
using Parser = ply::ply_parser;

/// Takes what the parser finds.
class Collector {
 public:
  void attachTo(Parser& parser) {
    parser.element_definition_callback([this](const std::string& name, std::size_t count) {
      if (name == "vertex") soup_.vertices.reserve(count);
      if (name == "face") soup_.ends.reserve(count);
      return Parser::element_callbacks_type([] {},
                                            [this, is_vertex = name == "vertex"] {
                                              if (is_vertex) soup_.vertices.push_back(vertex_);
                                            });
    });
    parser.error_callback([this](std::size_t, const std::string& message) { error_ = message; });
    attachPlyScalars(parser, [this](auto type, const std::string& element, const std::string& name) {
      return scalar<decltype(type)>(element, name);
    });
    attachLists<ply::uint8, ply::uint16, ply::uint32>(parser);
  }

  PolygonSoup take() { return std::move(soup_); }
  const std::string& error() const { return error_; }
  int coordinates() const { return coordinates_; }

 private:
  template <class Type>
  std::function<void(Type)> scalar(const std::string& element, const std::string& name) {
    if (element != "vertex" || name.size() != 1 || name[0] < 'x' || name[0] > 'z') return nullptr;
    ++coordinates_;
    return [this, axis = name[0] - 'x'](Type value) { vertex_[axis] = static_cast<double>(value); };
  }

  template <class... Sizes>
  void attachLists(Parser& parser) {
    Parser::list_property_definition_callbacks_type callbacks;
    (attachLists<Sizes, ply::int8, ply::int16, ply::int32, ply::uint8, ply::uint16, ply::uint32>(callbacks),
     ...);
    parser.list_property_definition_callbacks(callbacks);
  }

  template <class Size, class... Types>
  void attachLists(Parser::list_property_definition_callbacks_type& callbacks) {
    ((callbacks.get<Size, Types>() =
          [this](const std::string& element, const std::string& name) {
            return list<Size, Types>(element, name);
          }),
     ...);
  }

  template <class Size, class Type>
  auto list(const std::string& element, const std::string& name) {
    using Callbacks = std::tuple<std::function<void(Size)>, std::function<void(Type)>, std::function<void()>>;
    const bool is_corners = name == "vertex_indices" || name == "vertex_index";
    const auto append = [this](Type value) { soup_.corners.push_back(static_cast<std::int64_t>(value)); };
    if (element == "face" && is_corners)
      return Callbacks([](Size) {}, append, [this] { soup_.endPolygon(); });
    if (element == "tristrips" && is_corners)
      return Callbacks([this](Size) { strip_begin_ = soup_.corners.size(); }, append,
                       [this] { endStrips(); });
    return Callbacks();
  }

  /// Triangles of strips that -1 keeps apart; every other one is listed the other way round.
  void endStrips() {
    const std::vector<std::int64_t> strip(soup_.corners.begin() + static_cast<std::ptrdiff_t>(strip_begin_),
                                          soup_.corners.end());
    soup_.corners.resize(strip_begin_);
    std::size_t first = 0;
    for (std::size_t i = 0; i < strip.size(); ++i) {
      if (strip[i] < 0) first = i + 1;
      if (strip[i] < 0 || i < first + 2) continue;
      const std::size_t odd = (i - first) % 2;
      for (const std::int64_t corner : {strip[i - 2 + odd], strip[i - 1 - odd], strip[i]})
        soup_.corners.push_back(corner);
      soup_.endPolygon();
    }
  }

  PolygonSoup soup_;
  core::Vec3 vertex_ = core::Vec3::Zero();
  int coordinates_ = 0;
  std::size_t strip_begin_ = 0;
  std::string error_;
};

}  // namespace

PolygonSoup readPlyMesh(const std::filesystem::path& file) {
  checkPlyHeader(file);
  Collector collector;
  Parser parser;
  collector.attachTo(parser);
  if (!parser.parse(file.string())) {
    const std::string reason = collector.error().empty() ? "" : " (" + collector.error() + ")";
    throw fileError(file.string(),
                    "is not a whole PLY file, cut off or damaged" + reason + "; copy or write it again");
  }
  if (collector.coordinates() == 3) return collector.take();
  throw fileError(file.string(), "its vertices lack one of the properties x, y, z; write the file again");
}

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl/io/ply/ply_parser.h>

#include <string>

namespace mlsmesh::apps {

/// Asks `make(Type(), element, name)` for what takes the values of each scalar property of a PLY file; an
/// empty function passes over them.
template <class Make>
void attachPlyScalars(pcl::io::ply::ply_parser& parser, const Make& make) {
  namespace ply = pcl::io::ply;
  pcl::io::ply::ply_parser::scalar_property_definition_callbacks_type callbacks;
  const auto attach = [&](auto type) {
    using Type = decltype(type);
    callbacks.get<Type>() = [make](const std::string& element, const std::string& name) {
      return make(Type(), element, name);
    };
  };
  attach(ply::int8());
  attach(ply::int16());
  attach(ply::int32());
  attach(ply::uint8());
  attach(ply::uint16());
  attach(ply::uint32());
  attach(ply::float32());
  attach(ply::float64());
  parser.scalar_property_definition_callbacks(callbacks);
}

}  // namespace mlsmesh::apps

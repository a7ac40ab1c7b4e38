// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "mlsmesh/parameters.h"

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <stdexcept>

namespace mlsmesh::apps {

using PlainCloud = pcl::PointCloud<pcl::PointXYZ>;
using OrientedCloud = pcl::PointCloud<pcl::PointNormal>;

/// What every method is given.
struct MethodInput {
  PlainCloud::ConstPtr cloud;            ///< all points in the order of the file, organised if it is
  PlainCloud::ConstPtr finite;           ///< those that are finite, at least one; not organised
  int threads = 1;                       ///< 0 = all; methods that know one only take one
  MultiresolutionParameters parameters;  ///< of our own methods, but for what these differ in
};

/// Thrown by a method that will not take its input; the text says why.
class Refusal : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace mlsmesh::apps

// SPDX-License-Identifier: BSD-3-Clause
#include "compare/peer_input.h"
#include "compare/reconstructors.h"

#include <pcl/conversions.h>
#include <pcl/surface/organized_fast_mesh.h>

namespace mlsmesh::apps {

pcl::PolygonMesh meshOrganized(const MethodInput& input, StageClock& clock) {
  if (!input.cloud->isOrganized()) throw Refusal("the cloud is not organised (its height is 1)");
  const double spacing = meanSpacing(input, clock);
  clock.begin("reconstruction");
  pcl::OrganizedFastMesh<pcl::PointXYZ> organized;
  organized.setTriangulationType(pcl::OrganizedFastMesh<pcl::PointXYZ>::TRIANGLE_ADAPTIVE_CUT);
  organized.setTrianglePixelSize(1);
  organized.setMaxEdgeLength(static_cast<float>(5 * spacing));
  organized.setInputCloud(input.cloud);
  pcl::PolygonMesh mesh;
  organized.reconstruct(mesh);
  pcl::toPCLPointCloud2(*input.cloud, mesh.cloud);  // it has moved points that are not finite to the origin
  clock.end();
  return mesh;
}

}  // namespace mlsmesh::apps

#include "renderer/scene/posing/apply_pose.h"

#include <algorithm>
#include <span>

#include "renderer/scene/geometry/clusters.h"
#include "renderer/scene/geometry/welding.h"

namespace gnomon {

void applyPose(const PosedShape& shape, int index, Scene& scene) {
  Primitive& primitive = scene.primitives[static_cast<std::size_t>(index)];
  std::copy(shape.positions.begin(), shape.positions.end(), scene.positions.begin() + primitive.baseVertex);
  for (std::size_t i = 0; i < shape.positions.size(); ++i) {
    VertexAttributes& attributes = scene.attributes[primitive.baseVertex + i];
    attributes.normal = shape.normals[i];
    if (!shape.tangents.empty()) attributes.tangent = shape.tangents[i];
  }
  const auto indices = std::span(scene.indices).subspan(primitive.firstIndex, primitive.indexCount);
  const std::vector<Cluster> clusters = clustersOf(indices, shape.positions);
  std::copy(clusters.begin(), clusters.end(), scene.clusters.begin() + primitive.firstCluster);
  primitive.bounds = {};
  for (const Cluster& cluster : clusters) primitive.bounds.add(cluster.bounds);
  const std::vector<std::uint32_t> welded = weldedIndices(indices, shape.positions);
  std::copy(welded.begin(), welded.end(), scene.welded.begin() + primitive.firstIndex);
  primitive.solid = boundsSolids(welded, shape.positions);
}

} // namespace gnomon

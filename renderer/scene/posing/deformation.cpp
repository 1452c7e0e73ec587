#include "renderer/scene/posing/deformation.h"

#include <algorithm>
#include <cmath>

#include "renderer/core/aabb.h"
#include "renderer/scene/geometry/mesh_source.h"

namespace gnomon {

namespace {

glm::vec3 readOr0(const AccessorView* view, std::uint32_t vertex) {
  return view ? glm::vec3(view->read(vertex)) : glm::vec3(0);
}

/// Only the vertices that move are kept: of most targets that is a small part.
MorphTarget readTarget(const MorphSource& source, const TriangleMesh& mesh, const std::string& pointer,
                       Findings& findings) {
  MorphTarget target;
  for (std::uint32_t i = 0; i < mesh.sources.size(); ++i) {
    const std::uint32_t vertex = mesh.sources[i];
    const MorphDelta delta{i, readOr0(source.positions, vertex), readOr0(source.normals, vertex),
                           readOr0(source.tangents, vertex)};
    if (!finite(delta.position) || !finite(delta.normal) || !finite(delta.tangent)) {
      findings.invalid(pointer, "The morph target has a number that is not finite.", {},
                       "at vertex " + std::to_string(vertex));
      return {};
    }
    if (delta.position != glm::vec3(0) || delta.normal != glm::vec3(0) || delta.tangent != glm::vec3(0)) {
      target.push_back(delta);
    }
  }
  return target;
}

/// Weights that do not sum to 1, by rounding or else, are scaled to; a vertex without weights follows its first joint.
Influences readInfluences(const PrimitiveSource& source, std::uint32_t vertex) {
  Influences influences;
  double sum = 0;
  for (std::size_t set = 0; set < source.joints.size(); ++set) {
    if (!source.joints[set]) continue;
    const glm::dvec4 joints = source.joints[set]->read(vertex);
    const glm::dvec4 weights = source.weights[set]->read(vertex);
    for (int i = 0; i < 4; ++i) {
      const std::size_t slot = 4 * set + static_cast<std::size_t>(i);
      influences.joints[slot] = static_cast<std::uint16_t>(joints[i]);
      const double weight = weights[i] > 0 && std::isfinite(weights[i]) ? weights[i] : 0;
      influences.weights[slot] = static_cast<float>(weight);
      sum += weight;
    }
  }
  if (!(sum > 0) || !std::isfinite(sum)) {
    influences.weights = {1};
    return influences;
  }
  for (float& weight : influences.weights) weight = static_cast<float>(static_cast<double>(weight) / sum);
  return influences;
}

} // namespace

Deformable buildDeformable(const PrimitiveSource& source, TriangleMesh mesh, Findings& findings) {
  Deformable deformable;
  for (std::size_t i = 0; i < source.targets.size(); ++i) {
    deformable.targets.push_back(
        readTarget(source.targets[i], mesh, pointerTo(source.pointer + "/targets", i), findings));
  }
  if (source.joints[0]) {
    deformable.influences.reserve(mesh.sources.size());
    for (const std::uint32_t vertex : mesh.sources) {
      deformable.influences.push_back(readInfluences(source, vertex));
      const auto& joints = deformable.influences.back().joints;
      deformable.greatestJoint =
          std::max<int>(deformable.greatestJoint, *std::max_element(joints.begin(), joints.end()));
    }
  }
  deformable.mesh = std::move(mesh);
  return deformable;
}

} // namespace gnomon

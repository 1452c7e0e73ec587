#include "renderer/scene/posing/deformation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/core/aabb.h"
#include "renderer/scene/document/gltf_document.h"
#include "renderer/scene/geometry/accessor_view.h"
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
  bool someNotFinite = false;
  for (std::uint32_t i = 0; i < mesh.sources.size(); ++i) {
    const std::uint32_t vertex = mesh.sources[i];
    const MorphDelta delta{i, readOr0(source.positions, vertex), readOr0(source.normals, vertex),
                           readOr0(source.tangents, vertex)};
    if (!finite(delta.position) || !finite(delta.normal) || !finite(delta.tangent)) {
      if (!someNotFinite) {
        findings.repair({"A morph target has numbers that are not finite", "it does not move those vertices"}, pointer,
                        {}, "at vertex " + std::to_string(vertex));
      }
      someNotFinite = true;
      continue;
    }
    if (delta.position != glm::vec3(0) || delta.normal != glm::vec3(0) || delta.tangent != glm::vec3(0)) {
      target.push_back(delta);
    }
  }
  return target;
}

bool isJoint(double number) {
  return number >= 0 && number <= std::numeric_limits<std::uint16_t>::max() && number == std::trunc(number);
}

/// Joints and weights, scaled to a sum of 1; without weights the first joint. `someNoJoint`: a weight was on no joint.
Influences readInfluences(const PrimitiveSource& source, std::uint32_t vertex, bool& someNoJoint) {
  Influences influences;
  double sum = 0;
  for (std::size_t set = 0; set < source.joints.size(); ++set) {
    if (!source.joints[set]) continue;
    AccessorView numbers = *source.joints[set];
    numbers.normalized = false; // whatever the file says: they name joints
    const glm::dvec4 joints = numbers.read(vertex);
    const glm::dvec4 weights = source.weights[set]->read(vertex);
    for (int i = 0; i < 4; ++i) {
      const std::size_t slot = 4 * set + static_cast<std::size_t>(i);
      const double weight = weights[i] > 0 && std::isfinite(weights[i]) ? weights[i] : 0;
      if (!isJoint(joints[i])) {
        someNoJoint = someNoJoint || weight > 0;
        continue;
      }
      influences.joints[slot] = static_cast<std::uint16_t>(joints[i]);
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

bool isOfFloatMatrices(const gltf::Accessor& accessor) {
  return accessor.type == ElementType::mat4 && accessor.componentType == ComponentType::float32;
}

const Repair kSkinLeftOut{"The inverse bind matrices of a skin can't be read", "what it would deform follows its node"};

/// False, and a repair, where they are not one finite MAT4 of floats a joint.
bool readBindMatrices(const LoadContext& load, std::size_t accessor, const std::string& pointer, Skin& skin) {
  const AccessorView& view = load.accessors[accessor];
  const std::size_t joints = skin.joints.size();
  if (view.faulty || !isOfFloatMatrices(load.document.model.accessors[accessor]) || view.count < joints) {
    load.findings.repair(kSkinLeftOut, pointer, std::to_string(joints) + " or more MAT4 of floats");
    return false;
  }
  for (std::size_t joint = 0; joint < joints; ++joint) {
    glm::dmat4& matrix = skin.jointFromMesh[joint];
    matrix = view.readMatrix(joint);
    for (int column = 0; column < 4; ++column) matrix[column].w = column < 3 ? 0 : 1; // affine, whatever was rounded
    if (finite(matrix)) continue;
    load.findings.repair(kSkinLeftOut, pointer, "finite numbers", "joint " + std::to_string(joint));
    return false;
  }
  return true;
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
    bool someNoJoint = false;
    for (const std::uint32_t vertex : mesh.sources) {
      deformable.influences.push_back(readInfluences(source, vertex, someNoJoint));
      const Influences& added = deformable.influences.back();
      for (std::size_t i = 0; i < added.joints.size(); ++i) {
        if (added.weights[i] > 0) deformable.greatestJoint = std::max<int>(deformable.greatestJoint, added.joints[i]);
      }
    }
    if (someNoJoint) findings.repair({"A vertex names no joint", "it follows its other joints"}, source.pointer);
  }
  deformable.mesh = std::move(mesh);
  return deformable;
}

std::vector<Skin> readSkins(const LoadContext& load) {
  Findings& findings = load.findings;
  const std::vector<gltf::Skin>& sources = load.document.model.skins;
  std::vector<Skin> skins;
  std::size_t joints = 0;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const std::string pointer = pointerTo("/skins", i);
    joints += sources[i].joints.size();
    if (joints > load.limits.maxJoints) {
      findings.tooLarge(pointer + "/joints", "The skins have too many joints.", std::to_string(load.limits.maxJoints),
                        std::to_string(joints));
      return {};
    }
    if (sources[i].joints.empty()) {
      findings.repair({"A skin has no joints", "what it would deform follows its node"}, pointer + "/joints");
    }
    Skin skin{sources[i].joints, {}};
    skin.jointFromMesh.resize(skin.joints.size(), glm::dmat4(1));
    const int matrices = sources[i].inverseBindMatrices;
    const bool sound = matrices < 0 || readBindMatrices(load, static_cast<std::size_t>(matrices),
                                                        pointer + "/inverseBindMatrices", skin);
    skins.push_back(sound ? std::move(skin) : Skin{});
  }
  return skins;
}
} // namespace gnomon

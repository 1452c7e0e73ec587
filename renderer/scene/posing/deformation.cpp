#include "renderer/scene/posing/deformation.h"

#include <algorithm>
#include <cmath>
#include <map>

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

namespace {

bool isOfFloatMatrices(const gltf::Accessor& accessor) {
  return accessor.type == ElementType::mat4 && accessor.componentType == ComponentType::float32;
}

void readBindMatrices(const LoadContext& load, std::size_t accessor, const std::string& pointer, Skin& skin) {
  Findings& findings = load.findings;
  const AccessorView& view = load.accessors[accessor];
  if (!isOfFloatMatrices(load.document.model.accessors[accessor])) {
    return findings.invalid(pointer, "Inverse bind matrices need a MAT4 accessor of floats.");
  }
  if (view.count < skin.joints.size()) {
    return findings.invalid(pointer, "The skin has fewer inverse bind matrices than joints.",
                            ">= " + std::to_string(skin.joints.size()), std::to_string(view.count));
  }
  for (std::size_t joint = 0; joint < skin.joints.size(); ++joint) {
    glm::dmat4& matrix = skin.jointFromMesh[joint];
    matrix = view.readMatrix(joint);
    for (int column = 0; column < 4; ++column) matrix[column].w = column < 3 ? 0 : 1; // affine, whatever was rounded
    if (finite(matrix)) continue;
    return findings.invalid(pointer, "An inverse bind matrix is not finite.", {}, "of joint " + std::to_string(joint));
  }
}

class SkinCheck {
 public:
  explicit SkinCheck(const LoadContext& load)
      : model_(load.document.model), views_(load.accessors), limits_(load.limits), findings_(load.findings) {}

  void checkNode(std::size_t node) {
    const gltf::Node& source = model_.nodes[node];
    if (source.skin < 0 || source.mesh < 0) return;
    const std::size_t joints = model_.skins[static_cast<std::size_t>(source.skin)].joints.size();
    const double greatest = greatestJoint(static_cast<std::size_t>(source.mesh));
    if (greatest < static_cast<double>(joints)) return;
    findings_.invalid(pointerTo("/nodes", node) + "/skin", "The mesh uses a joint that the skin does not have.",
                      "below " + std::to_string(joints), std::to_string(static_cast<std::int64_t>(greatest)));
  }

 private:
  double greatestJoint(std::size_t mesh) {
    const auto known = ofMesh_.find(mesh);
    if (known != ofMesh_.end()) return known->second;
    double greatest = -1;
    for (const gltf::Primitive& primitive : model_.meshes[mesh].primitives) {
      for (const auto& [name, accessor] : primitive.attributes) {
        if (name.starts_with("JOINTS_")) greatest = std::max(greatest, greatestIn(static_cast<std::size_t>(accessor)));
      }
    }
    return ofMesh_[mesh] = greatest;
  }

  double greatestIn(std::size_t accessor) {
    const auto known = ofAccessor_.find(accessor);
    if (known != ofAccessor_.end()) return known->second;
    const AccessorView& view = views_[accessor];
    double greatest = -1;
    vertices_ += view.count;
    if (vertices_ > limits_.maxVertices) {
      findings_.tooLarge(pointerTo("/accessors", accessor), "The skinned meshes have too many vertices.",
                         std::to_string(limits_.maxVertices), std::to_string(vertices_));
    } else if (view.components != 4) {
      findings_.invalid(pointerTo("/accessors", accessor), "Joints need a VEC4 accessor.");
    } else {
      for (std::size_t i = 0; i < view.count; ++i) {
        const glm::dvec4 joints = view.read(i);
        greatest = std::max({greatest, joints.x, joints.y, joints.z, joints.w});
      }
    }
    return ofAccessor_[accessor] = greatest;
  }

  const gltf::Model& model_;
  const std::vector<AccessorView>& views_;
  const Limits& limits_;
  Findings& findings_;
  std::map<std::size_t, double> ofMesh_;
  std::map<std::size_t, double> ofAccessor_;
  std::size_t vertices_ = 0; ///< read so far: accessors may share their bytes or have none
};

} // namespace

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
      findings.invalid(pointer + "/joints", "The skin has no joints.", ">= 1", "0");
      continue;
    }
    Skin skin{sources[i].joints, {}};
    skin.jointFromMesh.resize(skin.joints.size(), glm::dmat4(1));
    if (sources[i].inverseBindMatrices >= 0) {
      readBindMatrices(load, static_cast<std::size_t>(sources[i].inverseBindMatrices), pointer + "/inverseBindMatrices",
                       skin);
    }
    skins.push_back(std::move(skin));
  }
  return skins;
}

void checkJoints(const LoadContext& load) {
  SkinCheck check(load);
  for (std::size_t node = 0; node < load.document.model.nodes.size(); ++node) check.checkNode(node);
}

} // namespace gnomon

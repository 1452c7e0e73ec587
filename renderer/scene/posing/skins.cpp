#include "renderer/scene/posing/skins.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/core/aabb.h"
#include "renderer/scene/geometry/accessor_view.h"

namespace gnomon {

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

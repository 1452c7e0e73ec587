#include "renderer/scene/posing/joint_checks.h"

#include <algorithm>
#include <map>

namespace gnomon {

namespace {

class SkinCheck {
 public:
  SkinCheck(const GltfDocument& document, const std::vector<AccessorView>& views, const Limits& limits,
            Findings& findings)
      : document_(document), views_(views), limits_(limits), findings_(findings) {}

  void checkNode(std::size_t node) {
    const tinygltf::Node& source = document_.model.nodes[node];
    if (source.skin < 0) return;
    if (source.mesh < 0) return;
    const std::size_t joints = document_.json["skins"][static_cast<std::size_t>(source.skin)]["joints"].size();
    const double greatest = greatestJoint(static_cast<std::size_t>(source.mesh));
    if (greatest < static_cast<double>(joints)) return;
    findings_.invalid(pointerTo("/nodes", node) + "/skin", "The mesh names a joint that the skin does not have.",
                      "below " + std::to_string(joints), std::to_string(static_cast<std::int64_t>(greatest)));
  }

 private:
  double greatestJoint(std::size_t mesh) {
    const auto known = ofMesh_.find(mesh);
    if (known != ofMesh_.end()) return known->second;
    double greatest = -1;
    for (const tinygltf::Primitive& primitive : document_.model.meshes[mesh].primitives) {
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
      findings_.invalid(pointerTo("/accessors", accessor), "Joints need an accessor of the type VEC4.");
    } else {
      for (std::size_t i = 0; i < view.count; ++i) {
        const glm::dvec4 joints = view.read(i);
        greatest = std::max({greatest, joints.x, joints.y, joints.z, joints.w});
      }
    }
    return ofAccessor_[accessor] = greatest;
  }

  const GltfDocument& document_;
  const std::vector<AccessorView>& views_;
  const Limits& limits_;
  Findings& findings_;
  std::map<std::size_t, double> ofMesh_;
  std::map<std::size_t, double> ofAccessor_;
  std::size_t vertices_ = 0; ///< read so far: accessors may share their bytes or have none
};

} // namespace

void checkJoints(const GltfDocument& document, const std::vector<AccessorView>& views, const Limits& limits,
                 Findings& findings) {
  SkinCheck check(document, views, limits, findings);
  for (std::size_t node = 0; node < document.model.nodes.size(); ++node) check.checkNode(node);
}

} // namespace gnomon

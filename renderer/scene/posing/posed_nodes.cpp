#include "renderer/scene/posing/posed_nodes.h"

#include <map>
#include <set>
#include <tuple>

#include "renderer/core/aabb.h"
#include "renderer/core/stop.h"
#include "renderer/scene/animation/animations.h"
#include "renderer/scene/geometry/mesh_source.h"
#include "renderer/scene/posing/pose.h"

namespace gnomon {

namespace {

class Posing {
 public:
  Posing(const LoadContext& load, const NodeTree& tree, const std::vector<BuiltMesh>& meshes, Deformation& deformation,
         Scene& scene)
      : model_(load.document.model),
        limits_(load.limits),
        findings_(load.findings),
        tree_(tree),
        meshes_(meshes),
        deformation_(deformation),
        scene_(scene),
        moving_(nodesWithMovingWeights(model_)) {}

  PosedMesh poseNode(std::size_t node) {
    const gltf::Node& source = model_.nodes[node];
    if (source.mesh < 0) return {};
    const BuiltMesh& mesh = meshes_[static_cast<std::size_t>(source.mesh)];
    if (mesh.deformables.empty()) return {};
    const std::vector<double> weights = weightsOf(node, static_cast<std::size_t>(source.mesh), mesh);
    const int skin = skinOf(node, mesh);
    const int own = moving_.contains(node) ? static_cast<int>(node) : -1;
    const auto [place, isNew] = posed_.try_emplace({source.mesh, skin, own, weights});
    if (isNew) place->second = makePrimitives(node, mesh, skin, weights);
    return place->second;
  }

 private:
  /// The node's weights, else the mesh's, else zeros; one a target, whatever the file has.
  std::vector<double> weightsOf(std::size_t node, std::size_t mesh, const BuiltMesh& built) {
    const std::size_t targets = deformable(built.deformables.front()).targets.size();
    const bool own = model_.nodes[node].weights.has_value();
    std::vector<double> weights =
        (own ? model_.nodes[node].weights : model_.meshes[mesh].weights).value_or(std::vector<double>(targets, 0.0));
    if (own && weights.size() != targets) { // of meshes it is told where they are read
      findings_.repair(kOtherWeights, pointerTo("/nodes", node) + "/weights", std::to_string(targets),
                       std::to_string(weights.size()));
    }
    weights.resize(targets, 0.0);
    return weights;
  }

  /// What deforms the mesh at a node; -1 = no skin.
  int skinOf(std::size_t node, const BuiltMesh& mesh) {
    const int skin = model_.nodes[node].skin;
    if (skin < 0) return -1;
    const std::size_t joints = deformation_.skins[static_cast<std::size_t>(skin)].joints.size();
    if (joints == 0) return -1;
    for (const int index : mesh.deformables) {
      const int greatest = deformable(index).greatestJoint;
      if (greatest < static_cast<int>(joints)) continue;
      findings_.repair({"A mesh uses joints that its skin does not have", "its vertices follow their other joints"},
                       pointerTo("/nodes", node) + "/skin", "below " + std::to_string(joints),
                       std::to_string(greatest));
    }
    return skin;
  }

  PosedMesh makePrimitives(std::size_t node, const BuiltMesh& mesh, int skin, const std::vector<double>& weights) {
    PosedMesh made;
    if (skin >= 0) made.worldFromSkin = jointsOf(skin).worldFromLocal;
    for (const int index : mesh.deformables) {
      stopIfAsked();
      const Deformable& source = deformable(index);
      const bool skinned = skin >= 0 && !source.influences.empty();
      if (!withinLimits(node, source)) return {};
      const PosedShape shape =
          pose(source, weights, skinned ? jointsOf(skin).localFromMesh : std::span<const glm::dmat4>());
      if (!finite(shape.bounds)) {
        findings_.invalid(pointerTo("/nodes", node), "The posed mesh has positions that are not finite.");
        return {};
      }
      const int primitive = appendPrimitive(source.mesh, source.material, scene_);
      scene_.primitives.back().variantMaterials = source.variantMaterials;
      applyPose(shape, primitive, scene_);
      (skinned ? made.followingSkin : made.followingNode).push_back(primitive);
      deformation_.posed.push_back({primitive, index, static_cast<int>(node), skinned ? skin : -1, weights});
    }
    return made;
  }

  const SkinPose& jointsOf(int skin) {
    const auto [place, isNew] = joints_.try_emplace(skin);
    if (isNew) place->second = poseSkin(deformation_.skins[static_cast<std::size_t>(skin)], tree_.worldFromNode);
    return place->second;
  }

  /// Each node may have a copy of its own, so that what the meshes come to is counted here once more.
  bool withinLimits(std::size_t node, const Deformable& source) {
    for (const MorphTarget& target : source.targets) morphed_ += target.size();
    const auto within = [&](const char* what, std::size_t limit, std::size_t actual) {
      if (actual <= limit) return true;
      findings_.tooLarge(pointerTo("/nodes", node) + "/mesh",
                         std::string("The posed meshes have too many ") + what + ".", std::to_string(limit),
                         std::to_string(actual));
      return false;
    };
    return within("vertices", limits_.maxVertices, scene_.positions.size() + source.mesh.positions.size()) &&
           within("triangles", limits_.maxTriangles, (scene_.indices.size() + source.mesh.indices.size()) / 3) &&
           within("morphed vertices", limits_.maxMorphedVertices, morphed_);
  }

  const Deformable& deformable(int index) const { return deformation_.deformables[static_cast<std::size_t>(index)]; }

  const gltf::Model& model_;
  const Limits& limits_;
  Findings& findings_;
  const NodeTree& tree_;
  const std::vector<BuiltMesh>& meshes_;
  Deformation& deformation_;
  Scene& scene_;
  std::set<std::size_t> moving_;
  std::map<int, SkinPose> joints_; ///< by skin
  std::size_t morphed_ = 0;
  /// By mesh, skin, the node if its weights are animated, and weights.
  std::map<std::tuple<int, int, int, std::vector<double>>, PosedMesh> posed_;
};

} // namespace

std::vector<PosedMesh> poseNodes(const LoadContext& load, const NodeTree& tree, const std::vector<BuiltMesh>& meshes,
                                 Deformation& deformation, Scene& scene) {
  Posing posing(load, tree, meshes, deformation, scene);
  std::vector<PosedMesh> posed(load.document.model.nodes.size());
  for (std::size_t node = 0; node < posed.size() && !load.findings.refused(); ++node) {
    posed[node] = posing.poseNode(node);
  }
  return posed;
}

} // namespace gnomon

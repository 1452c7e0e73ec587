#include "renderer/scene/animation/pose_scene.h"

#include <cmath>
#include <map>

#include "renderer/scene/animation/sampling.h"
#include "renderer/scene/graph/cameras.h"
#include "renderer/scene/graph/lights.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/graph/placing.h"
#include "renderer/scene/materials/variants.h"
#include "renderer/scene/posing/apply_pose.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/posing/pose.h"

namespace gnomon {

namespace {

using Weights = std::map<int, std::vector<double>>; ///< by node

/// The nodes' transforms at a time, and the weights of those whose weights move.
struct MovedNodes {
  std::vector<LocalTransform> locals;
  Weights weights;
};

MovedNodes moveNodes(const Motion& motion, const Animation& animation, double timeSeconds) {
  MovedNodes moved{motion.locals, {}};
  std::vector<double> value;
  for (const Channel& channel : animation.channels) {
    const Sampler& sampler = animation.samplers[channel.sampler];
    value.resize(sampler.components);
    sample(sampler, timeSeconds, value);
    LocalTransform& local = moved.locals[static_cast<std::size_t>(channel.node)];
    switch (channel.path) {
      case ChannelPath::translation:
        local.translation = {value[0], value[1], value[2]};
        break;
      case ChannelPath::rotation:
        local.rotation = glm::dquat(value[3], value[0], value[1], value[2]);
        break;
      case ChannelPath::scale:
        local.scale = {value[0], value[1], value[2]};
        break;
      case ChannelPath::weights:
        moved.weights[channel.node] = value;
        break;
    }
  }
  return moved;
}

std::vector<SkinPose> poseSkins(const Scene& scene, const NodePlaces& places) {
  std::vector<SkinPose> skins;
  if (!scene.deformation) return skins;
  for (const Skin& skin : scene.deformation->skins) skins.push_back(poseSkin(skin, places.worldFromNode));
  return skins;
}

/// False where a vertex is not finite.
bool poseVertices(const std::vector<SkinPose>& skins, const Weights& weights, Scene& scene) {
  if (!scene.deformation) return true;
  for (const PosedPrimitive& posed : scene.deformation->posed) {
    const Deformable& source = scene.deformation->deformables[static_cast<std::size_t>(posed.deformable)];
    const auto moving = weights.find(posed.node);
    const std::span<const glm::dmat4> joints =
        posed.skin < 0 ? std::span<const glm::dmat4>() : skins[static_cast<std::size_t>(posed.skin)].localFromMesh;
    const PosedShape shape = pose(source, moving == weights.end() ? posed.weights : moving->second, joints);
    if (!finite(shape.bounds)) return false;
    applyPose(shape, posed.primitive, scene);
  }
  return true;
}

/// False where an instance is not finite. What is flat, and what has no direction left, is left out.
bool placeView(const MovingView& moving, const NodePlaces& places, const std::vector<SkinPose>& skins,
               const Scene& scene, SceneView& view) {
  view.instances.reserve(moving.placements.size());
  for (const Placement& placement : moving.placements) {
    const glm::dmat4 worldFromLocal =
        placement.skin >= 0 ? skins[static_cast<std::size_t>(placement.skin)].worldFromLocal
                            : places.worldFromNode[static_cast<std::size_t>(placement.node)] * placement.nodeFromCopy;
    if (isFlat(worldFromLocal)) continue;
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(placement.primitive)];
    Instance instance;
    instance.node = placement.node;
    instance.primitive = placement.primitive;
    instance.worldFromLocal = worldFromLocal;
    instance.bounds = transformed(worldFromLocal, primitive.bounds);
    if (!finite(instance.bounds)) return false;
    view.bounds.add(instance.bounds);
    view.triangles += primitive.indexCount / 3;
    view.instances.push_back(instance);
  }
  for (const SceneCamera& camera : moving.cameras) {
    auto placed = placedAt(places.worldFromUnscaled[static_cast<std::size_t>(camera.node)], camera);
    if (placed) view.cameras.push_back(*std::move(placed));
  }
  for (const SceneLight& light : moving.lights) {
    auto placed = placedAt(places.worldFromUnscaled[static_cast<std::size_t>(light.node)], light);
    if (placed) view.lights.push_back(*std::move(placed));
  }
  return true;
}

} // namespace

Result<std::shared_ptr<const Scene>> poseScene(const Scene& scene, const Animation& animation, double timeSeconds) {
  const Problem lost{ProblemCode::invalidValue, "/animation",
                     "At this time the animation takes something beyond what is finite.", "",
                     std::to_string(timeSeconds) + " seconds"};
  const Motion& motion = *scene.motion;
  const MovedNodes moved = moveNodes(motion, animation, timeSeconds);
  const NodePlaces places = placeNodes(motion.order, motion.parents, moved.locals);
  if (firstLost(places, motion.order)) return lost;

  auto posed = std::make_shared<Scene>(scene);
  posed->motion.reset();
  posed->poses.reset();
  const std::vector<SkinPose> skins = poseSkins(scene, places);
  if (!poseVertices(skins, moved.weights, *posed)) return lost;
  posed->scenes.assign(motion.views.size(), {});
  for (std::size_t i = 0; i < motion.views.size(); ++i) {
    if (!placeView(motion.views[i], places, skins, *posed, posed->scenes[i])) return lost;
  }
  std::vector<SceneView> variants = variantViews(*posed, posed->scenes);
  for (SceneView& view : variants) posed->scenes.push_back(std::move(view));
  return std::shared_ptr<const Scene>(std::move(posed));
}

} // namespace gnomon

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "renderer/core/aabb.h"
#include "renderer/core/linear_algebra.h"
#include "renderer/core/stop.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/animation/posed_scene.h"
#include "renderer/scene/graph/attachments.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/materials/materials.h"
#include "renderer/scene/posing/deformation.h"
#include "renderer/scene/posing/pose.h"
#include "renderer/scene/reach.h"

namespace gnomon {

namespace {

using Weights = std::map<int, std::vector<double>>; ///< by node

/// The nodes at a time.
struct MovedNodes {
  std::vector<LocalTransform> locals;
  std::vector<bool> visible; ///< each by itself
  Weights weights;           ///< of those whose weights move
};

void animate(const Animation& animation, double timeSeconds, MovedNodes& nodes) {
  std::vector<double> value;
  for (const Channel& channel : animation.channels) {
    const Sampler& sampler = animation.samplers[channel.sampler];
    value.resize(sampler.components);
    sample(sampler, timeSeconds, value);
    LocalTransform& local = nodes.locals[static_cast<std::size_t>(channel.node)];
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
        nodes.weights[channel.node] = value;
        break;
      case ChannelPath::visibility:
        nodes.visible[static_cast<std::size_t>(channel.node)] = value[0] != 0;
        break;
    }
  }
}

MovedNodes moveNodes(const Motion& motion, const PoseInput& input) {
  MovedNodes nodes{motion.locals, motion.visible, {}};
  if (input.animation != nullptr) animate(*input.animation, input.timeSeconds, nodes);
  for (const NodePlace& place : input.places) nodes.locals[place.node] = moved(nodes.locals[place.node], place);
  return nodes;
}

/// What a pose places by.
struct PosedGraph {
  NodePlaces places;
  std::vector<bool> hidden; ///< the node or one above it is not visible
  std::vector<SkinPose> skins;
  std::optional<Properties> properties; ///< where the animation moves any
};

std::vector<SkinPose> poseSkins(const Scene& scene, const NodePlaces& places) {
  std::vector<SkinPose> skins;
  if (!scene.deformation) return skins;
  for (const Skin& skin : scene.deformation->skins) skins.push_back(poseSkin(skin, places.worldFromNode));
  return skins;
}

bool isAtRest(const PosedPrimitive& posed, const std::vector<SkinPose>& skins, const std::vector<SkinPose>& resting,
              const Weights& weights) {
  if (const auto moving = weights.find(posed.node); moving != weights.end() && moving->second != posed.weights) {
    return false;
  }
  const auto skin = static_cast<std::size_t>(posed.skin);
  return posed.skin < 0 || skins[skin].localFromMesh == resting[skin].localFromMesh;
}

/// The vertices that are not as the rest pose has them. Nothing, or the node of one that is not finite.
std::optional<std::size_t> poseVertices(const Motion& motion, const std::vector<SkinPose>& skins,
                                        const Weights& weights, Scene& scene) {
  if (!scene.deformation) return std::nullopt;
  const std::vector<SkinPose> resting = poseSkins(scene, placeNodes(motion.order, motion.parents, motion.locals));
  for (const PosedPrimitive& posed : scene.deformation->posed) {
    if (isAtRest(posed, skins, resting, weights)) continue;
    const Deformable& source = scene.deformation->deformables[static_cast<std::size_t>(posed.deformable)];
    const auto moving = weights.find(posed.node);
    const std::span<const glm::dmat4> joints =
        posed.skin < 0 ? std::span<const glm::dmat4>() : skins[static_cast<std::size_t>(posed.skin)].localFromMesh;
    const PosedShape shape = pose(source, moving == weights.end() ? posed.weights : moving->second, joints);
    if (!finite(shape.bounds)) return static_cast<std::size_t>(posed.node);
    applyPose(shape, posed.primitive, scene);
  }
  return std::nullopt;
}

/// Of what takes a node, or the mesh on it, beyond reach: the nearest place above it, else any, else the animation.
Problem lost(const Scene& scene, const PoseInput& input, std::size_t node) {
  const Motion& motion = *scene.motion;
  const std::string title = nodeTitle(node, scene.nodes[node].name);
  const NodePlace* mover = input.places.empty() ? nullptr : &input.places.back();
  for (int up = static_cast<int>(node); up >= 0; up = motion.parents[static_cast<std::size_t>(up)]) {
    const auto place = std::ranges::lower_bound(input.places, static_cast<std::size_t>(up), {}, &NodePlace::node);
    if (place == input.places.end() || place->node != static_cast<std::size_t>(up)) continue;
    mover = &*place;
    break;
  }
  if (mover == nullptr) {
    return {ProblemCode::invalidValue, "/animation", "At this time the animation takes something too far.",
            reachLimit(), title + " at " + std::to_string(input.timeSeconds) + " seconds"};
  }
  return {ProblemCode::invalidValue, "/nodes/" + std::to_string(mover->entry), "This place takes something too far.",
          reachLimit(), title};
}

Problem disallowed(const std::string& pointer, double timeSeconds, const std::string& detail) {
  return {ProblemCode::invalidValue, "/animation",
          "At this time the animation gives " + inQuotes(pointer) + " a value that glTF does not allow." +
              (detail.empty() ? "" : " " + detail),
          "", std::to_string(timeSeconds) + " seconds"};
}

/// The file's properties at a time, clamped to their ranges; a problem at an excluded end, or where two members no
/// longer fit each other.
Result<Properties> moveProperties(const Properties& rest, const Animation& animation, double timeSeconds) {
  Properties moved = rest;
  for (const PropertyChannel& channel : animation.properties) {
    const PropertyTarget& target = channel.target;
    const std::span<double> value = numbersOf(moved, target);
    sample(animation.samplers[channel.sampler], timeSeconds, value);
    for (double& number : value) {
      number = std::clamp(number, target.min, target.max);
      if (target.minExcluded && number <= target.min) return disallowed(target.pointer, timeSeconds, "");
    }
  }
  Findings findings;
  checkCameras(moved.cameras, findings);
  checkLights(moved.lights, findings);
  for (std::size_t i = 0; i < moved.cameras.size(); ++i) {
    if (moved.cameras[i].fault == rest.cameras[i].fault) continue;
    return disallowed(pointerTo("/cameras", i), timeSeconds, moved.cameras[i].fault);
  }
  for (std::size_t i = 0; i < moved.lights.size(); ++i) {
    if (moved.lights[i].fault == rest.lights[i].fault) continue;
    return disallowed(pointerTo("/extensions/KHR_lights_punctual/lights", i), timeSeconds, moved.lights[i].fault);
  }
  return moved;
}

/// Nothing, or the node of an instance that is beyond reach. What has no area is left out.
std::optional<std::size_t> placeInstances(const MovingView& moving, const PosedGraph& graph, const Scene& scene,
                                          SceneView& view) {
  view.instances.reserve(moving.placements.size());
  stopIfAsked();
  for (const Placement& placement : moving.placements) {
    const auto node = static_cast<std::size_t>(placement.node);
    const glm::dmat4 worldFromLocal = placement.skin >= 0
                                          ? graph.skins[static_cast<std::size_t>(placement.skin)].worldFromLocal
                                          : graph.places.worldFromNode[node] * placement.nodeFromCopy;
    if (graph.hidden[node] || hasNoArea(worldFromLocal)) continue;
    const Primitive& primitive = scene.primitives[static_cast<std::size_t>(placement.primitive)];
    Instance instance;
    instance.node = placement.node;
    instance.primitive = placement.primitive;
    instance.copy = placement.copy;
    instance.worldFromLocal = worldFromLocal;
    instance.bounds = transformed(worldFromLocal, primitive.bounds);
    if (!isWithinReach(instance.bounds)) return node;
    view.bounds.add(instance.bounds);
    view.triangles += primitive.indexCount / 3;
    view.instances.push_back(instance);
  }
  return std::nullopt;
}

void placeCameras(const MovingView& moving, const PosedGraph& graph, SceneView& view) {
  for (const FileCamera& file : moving.cameras) {
    const SceneCamera camera =
        graph.properties ? withLens(graph.properties->cameras[file.source], file.camera) : file.camera;
    auto placed = placedAt(graph.places.worldFromUnscaled[static_cast<std::size_t>(camera.node)], camera);
    if (placed) view.cameras.push_back(*std::move(placed));
  }
}

void placeLights(const MovingView& moving, const PosedGraph& graph, SceneView& view) {
  for (const FileLight& file : moving.lights) {
    SceneLight light = file.light;
    const auto node = static_cast<std::size_t>(light.node);
    if (graph.hidden[node]) continue;
    if (graph.properties) light.light = lightFrom(graph.properties->lights[file.source]);
    auto placed = placedAt(graph.places.worldFromUnscaled[node], std::move(light));
    if (placed) view.lights.push_back(*std::move(placed));
  }
}

} // namespace

Result<std::shared_ptr<const Scene>> poseScene(const Scene& scene, const PoseInput& input) {
  const Motion& motion = *scene.motion;
  const MovedNodes nodes = moveNodes(motion, input);
  PosedGraph graph;
  graph.places = placeNodes(motion.order, motion.parents, nodes.locals);
  if (const auto node = firstLost(graph.places, motion.order)) return lost(scene, input, *node);
  graph.hidden = hiddenNodes(motion.order, motion.parents, nodes.visible);
  if (input.animation != nullptr && !input.animation->properties.empty()) {
    auto properties = moveProperties(*motion.properties, *input.animation, input.timeSeconds);
    if (!properties) return std::move(properties).problems();
    graph.properties = *std::move(properties);
  }

  auto posed = std::make_shared<Scene>(scene);
  posed->motion.reset();
  posed->poses.reset();
  for (std::size_t i = 0; graph.properties && i < graph.properties->materials.size(); ++i) {
    posed->materials[i] = repainted(posed->materials[i], graph.properties->materials[i]);
  }
  if (!scene.placedNodes.empty()) posed->placedNodes = placedNodes(graph.places, graph.hidden);
  graph.skins = poseSkins(scene, graph.places);
  if (const auto node = poseVertices(motion, graph.skins, nodes.weights, *posed)) return lost(scene, input, *node);
  posed->scenes.assign(motion.views.size(), {});
  for (std::size_t i = 0; i < motion.views.size(); ++i) {
    posed->scenes[i].roots = scene.scenes[i].roots;
    if (const auto node = placeInstances(motion.views[i], graph, *posed, posed->scenes[i])) {
      return lost(scene, input, *node);
    }
    placeCameras(motion.views[i], graph, posed->scenes[i]);
    placeLights(motion.views[i], graph, posed->scenes[i]);
  }
  std::vector<SceneView> variants = variantViews(*posed, posed->scenes);
  for (SceneView& view : variants) posed->scenes.push_back(std::move(view));
  return std::shared_ptr<const Scene>(std::move(posed));
}

} // namespace gnomon

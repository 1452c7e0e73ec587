#include "renderer/scene/animation/posed_scene.h"

#include <algorithm>
#include <glm/gtc/type_ptr.hpp>
#include <limits>
#include <utility>

#include "renderer/core/linear_algebra.h"
#include "renderer/core/stop.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/findings.h"
#include "renderer/scene/found_nodes.h"
#include "renderer/scene/ground.h"

namespace gnomon {

namespace {

constexpr std::size_t kNamesTold = 16;

Problem unknownIndex(std::size_t count, int index) {
  return {ProblemCode::invalidValue, "/animation/index", "The file has no animation of that index.",
          count == 0 ? "no animations" : "0.." + std::to_string(count - 1), std::to_string(index)};
}

Problem unknownName(const std::vector<Animation>& animations, const std::string& name) {
  std::string names;
  for (std::size_t i = 0; i < animations.size() && i < kNamesTold; ++i) {
    if (animations[i].name.empty()) continue;
    names += (names.empty() ? "" : ", ") + inQuotes(animations[i].name);
  }
  if (animations.size() > kNamesTold) names += ", ...";
  return {ProblemCode::invalidValue, "/animation/name", "The file has no animation of that name.",
          names.empty() ? "no animations with names" : names, inQuotes(name)};
}

Result<std::size_t> animationOf(const std::vector<Animation>& animations, const AnimationMoment& moment) {
  if (moment.index) {
    const auto index = static_cast<std::size_t>(*moment.index);
    if (*moment.index < 0 || index >= animations.size()) return unknownIndex(animations.size(), *moment.index);
    return index;
  }
  const auto found = std::find_if(animations.begin(), animations.end(),
                                  [&](const Animation& animation) { return animation.name == *moment.name; });
  if (found == animations.end()) return unknownName(animations, *moment.name);
  return static_cast<std::size_t>(found - animations.begin());
}

void addParts(const NodeOptions& entry, NodePlace& place) {
  if (entry.matrix) {
    place = {.node = place.node, .matrix = glm::make_mat4(entry.matrix->data())};
    return;
  }
  place.matrix.reset();
  if (entry.translation) place.translation = toVector(*entry.translation);
  if (entry.rotation) {
    const auto& [x, y, z, w] = *entry.rotation;
    const glm::dquat rotation(w, x, y, z);
    place.rotation = rotation / glm::length(rotation);
  }
  if (entry.scale) place.scale = toVector(*entry.scale);
}

/// One place a node, ascending by node: of two entries the later counts, part by part, and a matrix and parts replace
/// each other. Problems at /nodes/i/node.
Result<std::vector<NodePlace>> nodePlaces(std::span<const NodeOptions> entries, const Scene& scene) {
  std::vector<NodePlace> places;
  if (std::ranges::none_of(entries, hasPlace)) return places;
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> placeOf(scene.nodes.size(), kNone);
  NodeFinder finder(scene);
  ProblemList problems;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!hasPlace(entries[i])) continue;
    const auto found = finder.find(*entries[i].node, "/nodes/" + std::to_string(i) + "/node");
    if (!found) {
      for (const Problem& problem : found.problems()) problems.add(problem);
      continue;
    }
    for (const std::size_t node : *found) {
      if (placeOf[node] == kNone) {
        placeOf[node] = places.size();
        places.push_back({.node = node});
      }
      NodePlace& place = places[placeOf[node]];
      addParts(entries[i], place);
      place.entry = i;
    }
  }
  if (!problems.empty()) return std::move(problems).take();
  std::ranges::sort(places, {}, &NodePlace::node);
  return places;
}

} // namespace

Result<std::shared_ptr<const Scene>> posedScene(const std::shared_ptr<const Scene>& scene, const Pose& pose) {
  const auto& moment = pose.animation;
  const bool animated = moment && (moment->index || moment->name);
  PoseCache::Key key;
  PoseInput input;
  if (animated) {
    static const std::vector<Animation> kNone;
    const std::vector<Animation>& animations = scene->motion ? scene->motion->animations : kNone;
    const auto index = animationOf(animations, *moment);
    if (!index) return index.problems();
    input.animation = &animations[*index];
    key.animation = *index;
    // Beyond its ends nothing moves, so that all times there are one.
    key.timeSeconds = std::clamp(moment->timeSeconds, 0.0, input.animation->durationSeconds);
  }
  auto places = nodePlaces(pose.nodes, *scene);
  if (!places) return places.problems();
  key.places = *std::move(places);
  input.timeSeconds = key.timeSeconds;
  input.places = key.places;
  auto posed = animated || !key.places.empty() ? scene->poses->get(key, [&] { return poseScene(*scene, input); })
                                               : Result<std::shared_ptr<const Scene>>(scene);
  if (!posed || !pose.ground) return posed;
  const auto grounded = [&] { return Result<std::shared_ptr<const Scene>>(groundedScene(**posed, *pose.ground)); };
  if (!scene->poses) return grounded();
  key.ground = pose.ground;
  return scene->poses->get(key, grounded);
}

Result<std::shared_ptr<const Scene>> posedScene(const Scene& scene, const Pose& pose) {
  return posedScene(std::shared_ptr<const Scene>(std::shared_ptr<const Scene>(), &scene), pose);
}

Result<std::shared_ptr<const Scene>> PoseCache::get(const Key& key, const Make& make) {
  const auto lock = lockUnlessStopped(mutex_);
  if (const Entry* const found = entries_.find(key, &Entry::key)) return found->scene;
  auto made = make();
  if (!made) return made;
  entries_.add({key, *made});
  entries_.keepNewest(kKept);
  return made;
}

bool hasPlace(const NodeOptions& entry) {
  return entry.matrix || entry.translation || entry.rotation || entry.scale;
}

LocalTransform moved(LocalTransform local, const NodePlace& place) {
  local.matrix = place.matrix;
  local.translation = place.translation.value_or(local.translation);
  local.rotation = place.rotation.value_or(local.rotation);
  local.scale = place.scale.value_or(local.scale);
  return local;
}

} // namespace gnomon

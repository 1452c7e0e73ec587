#include "renderer/scene/animation/posed_scene.h"

#include <algorithm>

#include "renderer/core/stop.h"
#include "renderer/scene/animation/motion.h"
#include "renderer/scene/animation/pose_scene.h"
#include "renderer/scene/findings.h"

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
  if (!animated && key.places.empty()) return scene;
  input.timeSeconds = key.timeSeconds;
  input.places = key.places;
  return scene->poses->get(key, [&] { return poseScene(*scene, input); });
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

} // namespace gnomon

#pragma once

#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "protocol/spec/scene_options.h"
#include "renderer/scene/graph/node_tree.h"
#include "renderer/scene/scene.h"

namespace gnomon {

struct Animation;

/// Where a frame puts a node, relative to its parent. What is absent stays as it is.
struct NodePlace {
  std::size_t node = 0;               ///< index into Scene::nodes
  std::size_t entry = 0;              ///< of the frame's nodes: the last that says so
  std::optional<glm::dmat4> matrix{}; ///< instead of the others
  std::optional<glm::dvec3> translation{};
  std::optional<glm::dquat> rotation{}; ///< of length 1
  std::optional<glm::dvec3> scale{};

  bool operator==(const NodePlace&) const = default;
};

/// Whether an entry says anything of a place.
bool hasPlace(const NodeOptions& entry);

/// A node's own transform with the place's parts. Parts beside a matrix of the file replace it.
LocalTransform moved(LocalTransform local, const NodePlace& place);

/// What moves the nodes of a scene: a moment of one of its animations, and after that the places that a frame gives.
struct Pose {
  std::optional<AnimationMoment> animation{}; ///< none, or one that names none: the file's rest pose
  std::span<const NodeOptions> nodes{};
  std::optional<GroundPlane> ground{}; ///< under it
};

/// How a frame poses its scene, without a ground. The spec outlives the result.
inline Pose poseOf(const FrameSpec& spec) {
  return {spec.animation, spec.nodes};
}

/// The scene in a pose, or itself where nothing moves and nothing is under it; kept for the next call. A problem for an
/// animation or node that the file lacks. Any thread.
Result<std::shared_ptr<const Scene>> posedScene(const std::shared_ptr<const Scene>& scene, const Pose& pose);

/// The same for a scene that outlives the result.
Result<std::shared_ptr<const Scene>> posedScene(const Scene& scene, const Pose& pose);

/// The last poses of a scene. Any thread; one that asks for a pose waits while another is made.
class PoseCache {
 public:
  struct Key {
    std::optional<std::size_t> animation;
    double timeSeconds = 0;
    std::vector<NodePlace> places;
    std::optional<GroundPlane> ground{};

    bool operator==(const Key&) const = default;
  };
  using Make = std::function<Result<std::shared_ptr<const Scene>>()>;

  /// The scene in that pose, made now if need be.
  Result<std::shared_ptr<const Scene>> get(const Key& key, const Make& make);

  static constexpr std::size_t kKept = 2;

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const Scene> scene;
  };

  std::timed_mutex mutex_;
  LruList<Entry> entries_;
};

/// How a scene is posed: an animation at a time, and after that places of nodes.
struct PoseInput {
  const Animation* animation = nullptr; ///< nullptr = the rest pose
  double timeSeconds = 0;
  std::span<const NodePlace> places{}; ///< ascending by node
};

/// The scene in a pose; shares images, and vertices where none is deformed. A problem at /nodes or /animation where
/// something is taken beyond reach (reach.h). REQUIRES: the scene has motion.
Result<std::shared_ptr<const Scene>> poseScene(const Scene& scene, const PoseInput& input);

} // namespace gnomon

#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "protocol/base/lru.h"
#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/scene/animation/node_places.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// What moves the nodes of a scene: a moment of one of its animations, and after that the places that a frame gives.
struct Pose {
  std::optional<AnimationMoment> animation{}; ///< none, or one that names none: the file's rest pose
  std::span<const NodeOptions> nodes{};
};

/// How a frame poses its scene. The spec outlives the result.
inline Pose poseOf(const FrameSpec& spec) {
  return {spec.animation, spec.nodes};
}

/// The scene in a pose: another scene, which shares the images and, where nothing is deformed, the vertices, and that
/// can be posed no further. The last poses of a scene are kept, so that asking for one again gives the same. Where
/// nothing moves, the scene itself. A problem for an animation or a node that the file does not have. Any thread.
Result<std::shared_ptr<const Scene>> posedScene(const std::shared_ptr<const Scene>& scene, const Pose& pose);

/// Alike; the result must not outlive the scene.
Result<std::shared_ptr<const Scene>> posedScene(const Scene& scene, const Pose& pose);

/// The last poses of a scene. Any thread; one that asks for a pose waits while another is made.
class PoseCache {
 public:
  struct Key {
    std::optional<std::size_t> animation;
    double timeSeconds = 0;
    std::vector<NodePlace> places;

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

} // namespace gnomon

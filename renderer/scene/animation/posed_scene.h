#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>

#include "protocol/base/result.h"
#include "protocol/spec/frame_spec.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// The scene at a moment of one of its animations: another scene, which shares the images and has no animations. The
/// last poses of a scene are kept, so that asking for one again gives the same. Without a moment, or with one that
/// names no animation, the scene itself. A problem for an animation that the file does not have. Any thread.
Result<std::shared_ptr<const Scene>> posedScene(const std::shared_ptr<const Scene>& scene,
                                                const std::optional<AnimationMoment>& moment);

/// Alike; the result must not outlive the scene.
Result<std::shared_ptr<const Scene>> posedScene(const Scene& scene, const std::optional<AnimationMoment>& moment);

/// The last poses of a scene. Any thread; one that asks for a pose waits while another is made.
class PoseCache {
 public:
  using Make = std::function<Result<std::shared_ptr<const Scene>>()>;

  /// The scene at a moment, made now if need be.
  Result<std::shared_ptr<const Scene>> get(std::size_t animation, double timeSeconds, const Make& make);

  static constexpr std::size_t kKept = 2;

 private:
  struct Entry {
    std::size_t animation = 0;
    double timeSeconds = 0;
    std::shared_ptr<const Scene> scene;
  };

  std::timed_mutex mutex_;
  std::list<Entry> entries_; ///< most recently used first
};

} // namespace gnomon

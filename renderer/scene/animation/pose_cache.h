#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>

#include "protocol/base/result.h"
#include "renderer/scene/scene.h"

namespace gnomon {

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

  std::mutex mutex_;
  std::list<Entry> entries_; ///< most recently used first
};

} // namespace gnomon

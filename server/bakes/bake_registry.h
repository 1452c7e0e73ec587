#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "protocol/base/lru.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// Where a bake is found: its scene and its key.
struct BakeName {
  std::string scene;
  std::string key;

  bool operator==(const BakeName&) const = default;
};

/// Bakes by name, in progress or done; those that were done or asked for longest ago are forgotten. Any thread.
class BakeRegistry {
 public:
  static constexpr std::size_t kMost = 1024; ///< a few kilobytes each

  /// Registers a bake that begins. The flag becomes true once it is removed.
  std::shared_ptr<const std::atomic<bool>> begin(const BakeName& name, const FrameSpec& spec);

  /// Keeps a bake that was begun, or forgets one that failed.
  void end(const BakeName& name, bool made);

  /// What a bake that is done was made from.
  std::optional<FrameSpec> find(const BakeName& name);

  /// Forgets a bake, and stops it where it is in progress. False = there is none.
  bool remove(const BakeName& name);

 private:
  struct Entry {
    BakeName name;
    FrameSpec spec;
    bool done = false;
    std::shared_ptr<std::atomic<bool>> removed;
  };

  std::mutex mutex_;
  LruList<Entry> entries_;
};

} // namespace gnomon

#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/base/lru.h"
#include "server/scenes/scene_page.h"
#include "server/scenes/store_size.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

using BundlePtr = std::shared_ptr<const FileDescriptor>;

/// Uploaded scenes that no directory keeps: their bundles in memory, within a budget, the least recently used dropped
/// first. Any thread.
class SceneMemory {
 public:
  /// `most`: scenes at once, >= 1.
  SceneMemory(std::size_t budgetBytes, std::size_t most) : budget_(budgetBytes), most_(most) {}

  /// False where it was there already. The newest stays, whatever its size. `bytes`: of the bundle.
  bool put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary);

  void replaceSummary(const std::string& id, const std::string& summary); ///< where the scene is there
  BundlePtr bundle(const std::string& id); ///< and marks it as used; nullptr = there is none
  std::optional<std::string> summary(const std::string& id) const;
  bool contains(const std::string& id) const;
  ScenePage page(std::string_view after, std::size_t limit) const; ///< see PageFinder
  StoreSize size() const;
  bool remove(const std::string& id);

 private:
  struct Entry {
    std::string id;
    BundlePtr bundle;
    std::uint64_t bundleBytes = 0;
    std::string summary;

    std::uint64_t bytes() const; ///< all that the scene takes here
  };
  const Entry* look(const std::string& id) const;

  mutable std::mutex mutex_;
  std::size_t budget_;
  std::size_t most_;
  LruList<Entry> entries_;
};

} // namespace gnomon

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/lru.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// How much is stored.
struct StoreSize {
  std::size_t scenes = 0;
  std::uint64_t bytes = 0; ///< of their bundles; in memory with their summaries
};

/// How a store that is elsewhere does; of one in memory, the defaults, and of a directory whether it can be read.
struct StoreState {
  bool isReachable = true;
  std::size_t connections = 0;
  std::uint64_t calls = 0;    ///< since the start
  std::uint64_t failures = 0; ///< of those: without an answer
  StoreSize inMemory{};       ///< scenes that need no call
  std::uint64_t hits = 0;     ///< bundles that were asked for, since the start: in memory
  std::uint64_t misses = 0;   ///< and read from the store
};

/// A part of the list of scenes.
struct ScenePage {
  std::vector<std::string> ids; ///< ascending
  bool hasMore = false;         ///< others follow the last
};

/// Finds a page among ids that come in any order, and never holds more than one page of them.
class PageFinder {
 public:
  /// The first `limit` >= 1 ids behind `after`; empty = from the beginning.
  PageFinder(std::string_view after, std::size_t limit) : after_(after), limit_(limit) {}

  void see(std::string_view id) {
    if (id <= after_ || (found_.size() > limit_ && id >= *found_.rbegin())) return;
    found_.emplace(id);
    if (found_.size() > limit_ + 1) found_.erase(std::prev(found_.end()));
  }

  ScenePage page() && {
    ScenePage page{{}, found_.size() > limit_};
    if (page.hasMore) found_.erase(std::prev(found_.end()));
    page.ids.assign(found_.begin(), found_.end());
    return page;
  }

 private:
  std::string after_;
  std::size_t limit_;
  std::set<std::string, std::less<>> found_; ///< one more than the page has, which shows that there are others
};

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

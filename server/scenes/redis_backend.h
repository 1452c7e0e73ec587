#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <mutex>
#include <set>

#include "server/redis/redis.h"
#include "server/redis/subscription.h"
#include "server/scenes/redis_parts.h"
#include "server/scenes/removal_delay.h"
#include "server/scenes/scene_backend.h"
#include "server/scenes/scene_memory.h"

namespace gnomon {

/// Scenes in Redis that other servers share (redis_scripts.h), and the last ones that were used in memory, too: these
/// need no Redis. While it is away, they are served, and all else is unavailable.
class RedisBackend : public SceneBackend {
 public:
  struct Options {
    std::size_t memoryBytes = 0;  ///< of bundles in memory
    std::size_t memoryScenes = 1; ///< >= 1; and as many of them at most
    std::uint64_t quotaBytes = 0; ///< of all bundles; 0 = as many as Redis takes
    std::chrono::seconds age{};   ///< scenes not used for so long go; 0 = never
  };

  RedisBackend(std::shared_ptr<redis::Redis> redis, Options options);

  Status checkRoom(std::uint64_t bytes) override;
  Result<bool> put(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary) override;
  Result<StoredBundle> bundle(const std::string& id) override;
  Status contains(const std::string& id) override;
  Status use(const std::string& id) override;
  Result<ScenePage> page(std::string_view after, std::size_t limit) override;
  StoreSize size() override;
  StoreState state() override;
  std::optional<std::string> summary(const std::string& id) override;
  void keepSummary(const std::string& id, const std::string& summary) override;
  void setAside(const std::string& id) override;
  Status remove(const std::string& id) override;
  void keepClean(const SceneListener& removed) override;
  void onRemoved(SceneListener listener) override;

 private:
  Status keepInMemory(const std::string& id, BundlePtr bundle, std::uint64_t bytes, const std::string& summary);
  Result<StoredBundle> fetch(const std::string& id);
  Result<std::vector<std::string>> missing(const std::vector<std::string>& ids);
  void forget(const std::string& id);
  void checkMemory();
  void markUsed();

  const std::shared_ptr<redis::Redis> redis_;
  const Options options_;
  const std::string channel_;
  SceneMemory memory_;
  std::array<std::timed_mutex, 16> fetching_; ///< by id: one that many ask for is read once
  std::mutex mutex_;
  std::set<std::string> used_; ///< in memory, since they were last marked so in Redis
  StoreSize size_;             ///< as last known
  std::atomic<std::uint64_t> hits_ = 0;
  std::atomic<std::uint64_t> misses_ = 0;
  RemovalDelay delay_;
  std::mutex telling_;
  SceneListener listener_;
  redis::Subscription removals_; ///< the last member: its thread uses the others
};

} // namespace gnomon

#pragma once

#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <variant>

#include "protocol/base/lru.h"
#include "protocol/base/scene_bundle.h"
#include "protocol/report/replies.h"
#include "renderer/core/stop.h"
#include "renderer/render.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// Work by key that runs once for all callers at the same time: the first does it, the others wait for its value. No
/// value outlives the callers. Any thread.
template <class Value>
class SingleFlight {
 public:
  /// Nothing where `goOn` says false while another caller does the work, which goes on. The work of this call listens
  /// by itself.
  std::optional<Value> run(const std::string& key, const std::function<Value()>& work, const GoOn& goOn = {}) {
    std::promise<Value> promise;
    {
      std::unique_lock lock(mutex_);
      if (const auto found = flights_.find(key); found != flights_.end()) {
        const std::shared_future<Value> flight = found->second;
        lock.unlock();
        return landed(flight, goOn);
      }
      flights_.emplace(key, promise.get_future().share());
    }
    try {
      Value value = work();
      land(key);
      promise.set_value(value);
      return value;
    } catch (...) {
      land(key);
      promise.set_exception(std::current_exception());
      throw;
    }
  }

 private:
  static std::optional<Value> landed(const std::shared_future<Value>& flight, const GoOn& goOn) {
    constexpr std::chrono::milliseconds kAskAgain{10};
    while (flight.wait_for(kAskAgain) != std::future_status::ready) {
      if (goOn && !goOn()) return std::nullopt;
    }
    return flight.get();
  }

  void land(const std::string& key) {
    const std::lock_guard lock(mutex_);
    flights_.erase(key);
  }

  std::mutex mutex_;
  std::map<std::string, std::shared_future<Value>> flights_;
};

/// A scene that is loaded, and its summary with its id.
struct LoadedScene {
  ScenePtr scene;
  SceneSummary summary;
};

/// Loaded scenes within a budget of memory, the least recently used dropped first. Any thread.
class SceneCache {
 public:
  explicit SceneCache(std::size_t budgetBytes) : budget_(budgetBytes) {}

  std::optional<LoadedScene> get(const std::string& id); ///< and marks it as used
  void put(LoadedScene loaded);                          ///< stays at least until the next put
  bool remove(const std::string& id);
  std::size_t bytes() const;
  std::size_t count() const;

 private:
  mutable std::mutex mutex_;
  const std::size_t budget_;
  LruList<LoadedScene> scenes_;
};

/// A bundle as an order brings it.
struct BundleFile {
  const FileDescriptor& file;
  bool isStored = false; ///< it comes from a disk, and may be damaged
  bool strict = false;   ///< refused where it violates glTF, whether or not it is loaded already
};

/// Why an order's scene can't be had.
struct LoadFailure {
  Problems problems{};
  bool damaged = false; ///< the bytes are not those that the id names
};

/// Loads scenes from their bundles and keeps them, within a budget. A scene is loaded once for all requests for it at
/// the same time, and shares the meshes and images that it has in common with those that are kept. Any thread.
class SceneLoader {
 public:
  /// `memoryBytes`: what loaded scenes may take together, and so the most for one. `limits`: of a single scene.
  SceneLoader(std::size_t memoryBytes, const Limits& limits)
      : limits_(limits), cache_(memoryBytes), most_(memoryBytes) {}

  /// `goOn`: false ends this call's loading, or its waiting for another call that loads the scene. Where that other one
  /// is stopped, this one loads.
  std::variant<LoadedScene, LoadFailure> get(const std::string& id, const BundleFile& bundle, const GoOn& goOn = {});

  /// Drops a scene from memory. Work in progress keeps what it has.
  void forget(const std::string& id);

  std::size_t bytes() const { return cache_.bytes(); }
  std::size_t count() const { return cache_.count(); }
  ReuseCounts reused() const { return known_.reused(); }

 private:
  std::variant<LoadedScene, LoadFailure> load(const std::string& id, const BundleFile& bundle, const GoOn& goOn);

  Limits limits_;
  SceneCache cache_;
  KnownContent known_;
  std::size_t most_;
  SingleFlight<std::variant<LoadedScene, LoadFailure>> loading_;
};

} // namespace gnomon

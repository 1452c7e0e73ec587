#pragma once

#include <exception>
#include <functional>
#include <future>
#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol/report/replies.h"
#include "renderer/render.h"

namespace gnomon {

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
  std::vector<SceneSummary> summaries() const; ///< by ascending id
  std::size_t bytes() const;

 private:
  mutable std::mutex mutex_;
  std::size_t budget_;
  std::size_t bytes_ = 0;
  std::list<LoadedScene> scenes_; ///< most recently used first
  std::map<std::string, std::list<LoadedScene>::iterator> byId_;
};

/// Work by key that runs once for all callers at the same time: the first does it, the others wait for its value. No
/// value outlives the callers. Any thread.
template <class Value>
class SingleFlight {
 public:
  Value run(const std::string& key, const std::function<Value()>& work) {
    std::promise<Value> promise;
    {
      std::unique_lock lock(mutex_);
      if (const auto found = flights_.find(key); found != flights_.end()) {
        const std::shared_future<Value> flight = found->second;
        lock.unlock();
        return flight.get();
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
  void land(const std::string& key) {
    const std::lock_guard lock(mutex_);
    flights_.erase(key);
  }

  std::mutex mutex_;
  std::map<std::string, std::shared_future<Value>> flights_;
};

} // namespace gnomon

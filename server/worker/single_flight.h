#pragma once

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "renderer/core/stop.h"

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

} // namespace gnomon

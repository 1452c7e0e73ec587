#pragma once

#include <exception>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <string>

namespace gnomon {

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

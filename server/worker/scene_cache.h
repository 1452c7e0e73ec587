#pragma once

#include <list>
#include <map>
#include <mutex>
#include <optional>
#include <string>

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
  std::size_t bytes() const;
  std::size_t count() const;

 private:
  mutable std::mutex mutex_;
  std::size_t budget_;
  std::size_t bytes_ = 0;
  std::list<LoadedScene> scenes_; ///< most recently used first
  std::map<std::string, std::list<LoadedScene>::iterator> byId_;
};

} // namespace gnomon

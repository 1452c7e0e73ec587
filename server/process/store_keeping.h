#pragma once

#include <thread>

#include "server/dispatch/dispatcher.h"
#include "server/scenes/scene_store.h"

namespace gnomon {

/// How often a store is kept clean.
struct KeepingPeriod {
  std::chrono::seconds age{};                                  ///< that of the store's options; 0 = scenes do not age
  std::chrono::milliseconds longest = std::chrono::minutes(1); ///< between two times
};

/// Keeps a store clean for as long as it exists: ever so often removes what is too old, and what servers that died have
/// left. Workers forget what is removed, by this server or another.
class StoreKeeping {
 public:
  /// Store and workers outlive it.
  StoreKeeping(SceneStore& store, Dispatcher& workers, const KeepingPeriod& period);
  ~StoreKeeping();
  StoreKeeping(const StoreKeeping&) = delete;
  StoreKeeping& operator=(const StoreKeeping&) = delete;

 private:
  SceneStore& store_;
  StopSignal stop_;
  std::thread thread_;
};

} // namespace gnomon

#pragma once

#include <thread>

#include "server/dispatch/dispatcher.h"
#include "server/scenes/scene_store.h"

namespace gnomon {

/// Keeps a store clean for as long as it exists: ever so often removes what is too old, which workers then forget, and
/// what servers that died have left.
class StoreKeeping {
 public:
  /// `age`: that of the store's options. Both outlive it.
  StoreKeeping(SceneStore& store, Dispatcher& workers, std::chrono::seconds age);
  ~StoreKeeping();
  StoreKeeping(const StoreKeeping&) = delete;
  StoreKeeping& operator=(const StoreKeeping&) = delete;

 private:
  StopSignal stop_;
  std::thread thread_;
};

} // namespace gnomon

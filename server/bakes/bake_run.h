#pragma once

#include <functional>
#include <memory>
#include <semaphore>

#include "renderer/render.h"
#include "server/bakes/bake_book.h"
#include "server/scenes/scene_cache.h"
#include "server/system/byte_budget.h"
#include "server/system/clock.h"

namespace gnomon {

/// What all bakes share. Outlives them.
struct BakeContext {
  Baker baker;
  ByteBudget& frameMemory;
  std::chrono::milliseconds timeout{600'000}; ///< from the handler's start to the report
  std::counting_semaphore<> running{1};       ///< how many more may run at once
  BakeBook book;
};

inline constexpr int kBakeRetrySeconds = 5; ///< Retry-After where the server is busy with bakes

/// What baking a spec takes in memory at most, one light after the other.
std::size_t bakeBytes(const FrameSpec& spec);

/// A bake as a file, made from what is kept of it, or baked again where that was dropped. `light`: as bakeFile takes
/// it. `gone`: as in BakeRun::report.
Result<Bytes> bakedFile(BakeContext& context, const LoadedScene& scene, const FrameSpec& spec, BakeFile kind,
                        std::optional<int> light, const std::function<bool()>& gone);

/// One bake in progress, on the caller's thread: frames are drawn beside it. It counts as running, and keeps its
/// memory, as long as it exists.
class BakeRun {
 public:
  /// A problem of code busy where enough bakes run already, or other work takes the memory.
  static Result<std::shared_ptr<BakeRun>> start(BakeContext& context, LoadedScene scene, const FrameSpec& spec,
                                                Clock::time_point deadline);
  ~BakeRun();
  BakeRun(const BakeRun&) = delete;
  BakeRun& operator=(const BakeRun&) = delete;

  const BakeName& name() const { return name_; }
  const ScenePtr& scene() const { return scene_.scene; }

  /// Bakes. `gone` is called often, by any thread; true ends the bake, as does whoever removes it from the book.
  Result<BakeReport> report(const std::function<bool()>& gone, const BakeListener& listener = {});

 private:
  BakeRun(BakeContext& context, LoadedScene scene, const FrameSpec& spec, Clock::time_point deadline);

  BakeContext& context_;
  LoadedScene scene_;
  FrameSpec spec_; ///< bakedParts
  BakeName name_;
  Clock::time_point deadline_;
  ByteLease memory_;
};

} // namespace gnomon

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "renderer/render.h"
#include "server/system/clock.h"

namespace gnomon {

/// A frame, and how long it waited for its turn.
struct DrawnFrame {
  Frame frame;
  double queuedMilliseconds = 0;
};

/// The thread that makes, owns and uses the renderer; first come, first served. Callers wait for their turn, and give
/// it up soon after their `goOn` says false.
class RenderThread {
 public:
  /// Returns once the renderer has drawn a small test frame with a shadow in it, or why it could not.
  static Result<std::unique_ptr<RenderThread>> start(const RendererOptions& options);
  ~RenderThread();

  const RendererInfo& info() const { return info_; }

  /// Renderer::infoFor; waits for its turn only where that may be another device than that of `info`. A problem of
  /// code unavailable where it was asked to stop before.
  Result<RendererInfo> infoFor(const FrameSpec& spec, const GoOn& goOn);

  /// Bakes for the frames of this thread, without waiting for it.
  const Baker& baker() const { return *baker_; }

  /// Of the frames of this thread; any other may use it.
  const std::shared_ptr<EnvironmentCache>& environments() const { return environments_; }

  /// Renderer::render; a problem of code unavailable where it was asked to stop before or while it drew. Throws what
  /// that throws: std::bad_alloc where the worker may use no more memory.
  Result<DrawnFrame> render(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles, const GoOn& goOn);

  /// The same, and calls `finish` with the frame, which encodes it: on this thread where that keeps all cores busy and
  /// no other call waits for them, since the cores that have drawn it are awake; else on the caller's. Throws what
  /// `finish` throws.
  using Finish = std::function<void(DrawnFrame&)>;
  Status renderAndFinish(const ScenePtr& scene, const FrameSpec& spec, const GoOn& goOn, const Finish& finish);

  /// Renderer::shimmer as flips in 1,000 points and a frame.
  Result<double> shimmer(const ScenePtr& scene, const FrameSpec& spec, std::span<const Camera> path, const GoOn& goOn);

 private:
  RenderThread();

  /// A caller's place in the queue. It leaves the queue when its work begins, or when its caller gives up.
  struct Turn {
    std::function<void()> work; ///< may refer to the caller's stack: the caller stays until it has ended
    std::mutex asking;          ///< held while the caller's goOn is asked, by one thread at a time
  };

  /// The result of `work`, which runs on the thread; a problem of code unavailable, and no run, where `goOn` says false
  /// before its turn. Work that has begun is waited for: it asks `goOn` itself.
  template <class T>
  Result<T> ask(const GoOn& goOn, const std::function<Result<T>()>& work);
  bool givesUp(const std::shared_ptr<Turn>& turn, const GoOn& goOn);
  bool isQueued(const std::shared_ptr<Turn>& turn);
  void serve();
  Result<DrawnFrame> draw(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles, const GoOn& goOn,
                          Clock::time_point asked);
  bool isAwaited();

  std::optional<Renderer> renderer_; ///< touched on the thread only
  RendererInfo info_;
  std::optional<Baker> baker_;
  std::shared_ptr<EnvironmentCache> environments_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::shared_ptr<Turn>> waiting_;
  bool ending_ = false;
  std::thread thread_;
};

/// Draws a small frame and looks for the shadow in it: the proof that this renderer works.
Status drawFirstFrame(Renderer& renderer);

} // namespace gnomon

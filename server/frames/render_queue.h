#pragma once

#include <future>
#include <memory>

#include "renderer/render.h"
#include "server/frames/job_queue.h"

namespace gnomon {

/// A request for one frame.
struct FrameJob {
  ScenePtr scene;
  FrameSpec spec;
  Clock::time_point deadline;
  std::function<bool()> clientGone;
  TileUse tiles = TileUse::kept;
};

/// A request for the shimmer along a path of cameras. One job, whatever its length.
struct ShimmerJob {
  ScenePtr scene;
  FrameSpec spec;
  std::vector<Camera> path;
  Clock::time_point deadline;
  std::function<bool()> clientGone;
};

/// A frame, and how long its job waited in the queue.
struct QueuedFrame {
  Frame frame;
  double queueMs = 0;
};

/// A bounded queue in front of the thread that makes, owns and uses the renderer.
class RenderQueue {
 public:
  /// Returns once the renderer has drawn a small test frame with a shadow in it, or why it could not.
  static Result<std::unique_ptr<RenderQueue>> start(const RendererOptions& options, std::size_t limit);

  const RendererInfo& info() const { return info_; }

  /// Bakes for the frames of this queue, without waiting in it.
  const Baker& baker() const { return *baker_; }

  /// Returns when the frame is drawn or its deadline has passed. A frame that bakes stops then, or when the client is
  /// gone; one that only draws is drawn to its end.
  std::variant<QueuedFrame, Problems, QueueFull> render(FrameJob job);

  /// Flips in 1,000 points and a frame; stops early where the deadline has passed or the client is gone.
  std::variant<double, Problems, QueueFull> shimmer(ShimmerJob job);

  /// True while a new job would not wait long: the queue is less than three quarters full.
  bool hasRoom() const;
  std::size_t waiting() const { return jobs_.waiting(); }
  std::size_t limit() const { return jobs_.limit(); }

  /// Runs the waiting jobs until `deadline`, drops the rest and ends the renderer's thread.
  void close(Clock::time_point deadline);

 private:
  explicit RenderQueue(std::size_t limit);

  /// `goOn`: false once the deadline has passed or the client is gone.
  template <class T>
  using Work = std::function<Result<T>(Renderer&, double waitedMs, const std::function<bool()>& goOn)>;

  /// The result of `work`, which runs on the queue's thread and is given how long it waited.
  template <class T>
  std::variant<T, Problems, QueueFull> ask(Clock::time_point deadline, std::function<bool()> clientGone, Work<T> work);

  std::optional<Renderer> renderer_; ///< touched on the queue's thread only
  RendererInfo info_;
  std::optional<Baker> baker_;
  JobQueue jobs_;
};

} // namespace gnomon

#include "server/worker/render_thread.h"

#include <exception>
#include <future>

#include "protocol/base/elapsed.h"
#include "server/worker/first_frame.h"

namespace gnomon {
namespace {

Problem stopped() {
  return {ProblemCode::unavailable, "", "The frame was stopped before it was drawn.", "", ""};
}

} // namespace

RenderThread::RenderThread() : thread_([this] { serve(); }) {}

RenderThread::~RenderThread() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RenderThread::serve() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) break;
    const auto work = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    work();
    lock.lock();
  }
  renderer_.reset(); // a context must be destroyed on the thread that made it
}

template <class T>
Result<T> RenderThread::ask(const std::function<Result<T>()>& work) {
  std::promise<Result<T>> answer;
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back([&] {
      try {
        answer.set_value(work());
      } catch (const std::exception&) {
        answer.set_exception(std::current_exception());
      }
    });
  }
  changed_.notify_one();
  return answer.get_future().get();
}

Result<std::unique_ptr<RenderThread>> RenderThread::start(const RendererOptions& options) {
  std::unique_ptr<RenderThread> thread(new RenderThread());
  try {
    const auto started = thread->ask<Done>([&]() -> Status {
      auto renderer = Renderer::create(options);
      if (!renderer) return std::move(renderer).problems();
      thread->renderer_ = *std::move(renderer);
      thread->info_ = thread->renderer_->info();
      thread->baker_ = thread->renderer_->baker();
      return drawFirstFrame(*thread->renderer_);
    });
    if (!started) return started.problems();
  } catch (const std::exception& error) {
    return Problem{ProblemCode::internal, "", "The first frame failed.", "", error.what()};
  }
  return thread;
}

Result<DrawnFrame> RenderThread::draw(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles, const GoOn& goOn,
                                      Clock::time_point asked) {
  const double queued = millisecondsSince(asked);
  if (!goOn()) return stopped();
  auto frame = renderer_->render(scene, spec, tiles, goOn);
  if (!frame) return std::move(frame).problems();
  return DrawnFrame{*std::move(frame), queued};
}

bool RenderThread::isAwaited() {
  const std::lock_guard lock(mutex_);
  return !waiting_.empty();
}

Result<DrawnFrame> RenderThread::render(const ScenePtr& scene, const FrameSpec& spec, TileUse tiles, const GoOn& goOn) {
  const auto asked = Clock::now();
  return ask<DrawnFrame>([&] { return draw(scene, spec, tiles, goOn, asked); });
}

Status RenderThread::renderAndFinish(const ScenePtr& scene, const FrameSpec& spec, const GoOn& goOn,
                                     const Finish& finish) {
  const auto asked = Clock::now();
  auto unfinished = ask<std::optional<DrawnFrame>>([&]() -> Result<std::optional<DrawnFrame>> {
    auto drawn = draw(scene, spec, TileUse::kept, goOn, asked);
    if (!drawn) return std::move(drawn).problems();
    if (spec.output.format != ImageFormat::png || isAwaited()) return std::optional(*std::move(drawn));
    finish(*drawn);
    return std::optional<DrawnFrame>();
  });
  if (!unfinished) return std::move(unfinished).problems();
  if (*unfinished) finish(**unfinished);
  return Done{};
}

Result<double> RenderThread::shimmer(const ScenePtr& scene, const FrameSpec& spec, std::span<const Camera> path,
                                     const GoOn& goOn) {
  return ask<double>([&]() -> Result<double> {
    const auto shimmer = renderer_->shimmer(scene, spec, path, [&](double) { return goOn(); });
    if (!shimmer) return shimmer.problems();
    return shimmer->perThousand();
  });
}

} // namespace gnomon

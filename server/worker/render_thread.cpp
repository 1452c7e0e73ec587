#include "server/worker/render_thread.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <future>

#include "protocol/base/elapsed.h"

namespace gnomon {
namespace {

/// A square of ground and, a metre above it, a smaller square; one index list serves both.
constexpr std::string_view kModel = R"({
  "asset": {"version": "2.0"},
  "scene": 0,
  "scenes": [{"nodes": [0, 1]}],
  "nodes": [{"mesh": 0}, {"mesh": 0, "translation": [0, 1, 0], "scale": [0.1, 1, 0.1]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
  "buffers": [{"byteLength": 60, "uri": "squares.bin"}],
  "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-5, 0, -5], "max": [5, 0, 5]},
    {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]
})";
constexpr std::array<float, 12> kCorners{-5, 0, -5, -5, 0, 5, 5, 0, 5, 5, 0, -5}; ///< metres
constexpr std::array<std::uint16_t, 6> kIndices{0, 1, 2, 0, 2, 3};                ///< counter-clockwise from above

SceneBundle firstBundle() {
  SceneBundle made;
  made.model.assign(kModel.begin(), kModel.end());
  Bytes buffer(sizeof kCorners + sizeof kIndices);
  std::memcpy(buffer.data(), kCorners.data(), sizeof kCorners);
  std::memcpy(buffer.data() + sizeof kCorners, kIndices.data(), sizeof kIndices);
  made.files.emplace("squares.bin", std::move(buffer));
  return made;
}

FrameSpec firstSpec() {
  FrameSpec made;
  made.width = 16;
  made.height = 16;
  made.camera.lookAt = EyeTarget{{0, 5, 0}, {0, 0, 0}, {0, 0, -1}};
  made.camera.perspective = Perspective{};
  Light sun;
  sun.sun = Sun{90, 45};
  made.lights = std::vector<Light>{sun};
  made.views = {View::shadow};
  return made;
}

/// True where some pixels are lit and some are not.
bool showsShadow(const Image& image) {
  return std::visit(
      [&](const auto& pixels) {
        if (pixels.empty() || image.channels.empty()) return false;
        auto darkest = pixels.front();
        auto brightest = pixels.front();
        for (std::size_t i = 0; i < pixels.size(); i += image.channels.size()) {
          darkest = std::min(darkest, pixels[i]);
          brightest = std::max(brightest, pixels[i]);
        }
        return darkest < brightest;
      },
      image.pixels);
}

Problem stopped() {
  return {ProblemCode::unavailable, "", "The frame was stopped before it was drawn.", "", ""};
}

} // namespace

Status drawFirstFrame(Renderer& renderer) {
  auto scene = loadScene(firstBundle());
  if (!scene) return std::move(scene).problems();
  auto frame = renderer.render(*scene, firstSpec());
  if (!frame) return std::move(frame).problems();
  if (frame->images.size() != 1 || !showsShadow(frame->images.front().image)) {
    return Problem{ProblemCode::backend, "", "The test frame that the renderer drew has no shadow in it.", "", ""};
  }
  return Done{};
}

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
    const auto turn = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    { const std::lock_guard asked(turn->asking); } // its caller may be asking now, and does not once it is out
    turn->work();
    lock.lock();
  }
  renderer_.reset(); // a context must be destroyed on the thread that made it
}

bool RenderThread::isQueued(const std::shared_ptr<Turn>& turn) {
  const std::lock_guard lock(mutex_);
  return std::find(waiting_.begin(), waiting_.end(), turn) != waiting_.end();
}

/// Whether the turn is out of the queue now and its work will never begin.
bool RenderThread::givesUp(const std::shared_ptr<Turn>& turn, const GoOn& goOn) {
  const std::lock_guard asked(turn->asking);
  if (!goOn || !isQueued(turn) || goOn()) return false;
  const std::lock_guard lock(mutex_);
  return std::erase(waiting_, turn) > 0;
}

template <class T>
Result<T> RenderThread::ask(const GoOn& goOn, const std::function<Result<T>()>& work) {
  constexpr std::chrono::milliseconds kAskAgain{10};
  // Not on this stack: the thread may still be setting the answer when this function has it.
  const auto answer = std::make_shared<std::promise<Result<T>>>();
  auto answered = answer->get_future();
  const auto turn = std::make_shared<Turn>();
  turn->work = [&work, answer] {
    try {
      answer->set_value(work());
    } catch (const std::exception&) {
      answer->set_exception(std::current_exception());
    }
  };
  {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(turn);
  }
  changed_.notify_one();
  while (answered.wait_for(kAskAgain) != std::future_status::ready && isQueued(turn)) {
    if (givesUp(turn, goOn)) return stopped();
  }
  return answered.get();
}

Result<std::unique_ptr<RenderThread>> RenderThread::start(const RendererOptions& options) {
  std::unique_ptr<RenderThread> thread(new RenderThread());
  try {
    const auto started = thread->ask<Done>({}, [&]() -> Status {
      auto renderer = Renderer::create(options);
      if (!renderer) return std::move(renderer).problems();
      thread->renderer_ = *std::move(renderer);
      thread->info_ = thread->renderer_->info();
      thread->baker_ = thread->renderer_->baker();
      thread->environments_ = thread->renderer_->environments();
      return drawFirstFrame(*thread->renderer_);
    });
    if (!started) return started.problems();
  } catch (const std::exception& error) {
    return Problem{ProblemCode::internal, "", "The first frame failed.", "", error.what()};
  }
  return thread;
}

Result<RendererInfo> RenderThread::infoFor(const FrameSpec& spec, const GoOn& goOn) {
  if (spec.device == DeviceChoice::auto_ || spec.device == info_.device) return info_;
  return ask<RendererInfo>(goOn, [&] { return renderer_->infoFor(spec); });
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
  return ask<DrawnFrame>(goOn, [&] { return draw(scene, spec, tiles, goOn, asked); });
}

Status RenderThread::renderAndFinish(const ScenePtr& scene, const FrameSpec& spec, const GoOn& goOn,
                                     const Finish& finish) {
  const auto asked = Clock::now();
  auto unfinished = ask<std::optional<DrawnFrame>>(goOn, [&]() -> Result<std::optional<DrawnFrame>> {
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
  return ask<double>(goOn, [&]() -> Result<double> {
    const auto shimmer = renderer_->shimmer(scene, spec, path, [&](double) { return goOn(); });
    if (!shimmer) return shimmer.problems();
    return shimmer->perThousand();
  });
}

} // namespace gnomon

#include "server/frames/render_queue.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>

#include "server/http/request_log.h"

namespace gnomon {
namespace {

Problem renderFailure() {
  return {ProblemCode::internal, "", "An internal error occurred while rendering.", "", ""};
}

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
        if (pixels.empty() || image.channels.empty()) {
          return false;
        }
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

/// Draws a small frame and looks for the shadow in it: the proof that this renderer works.
Status drawFirstFrame(Renderer& renderer) {
  auto scene = loadScene(firstBundle());
  if (!scene) {
    return std::move(scene).problems();
  }
  auto frame = renderer.render(*scene, firstSpec());
  if (!frame) {
    return std::move(frame).problems();
  }
  if (frame->images.size() != 1 || !showsShadow(frame->images.front().image)) {
    return Problem{ProblemCode::backend, "", "The test frame that the renderer drew has no shadow in it.", "", ""};
  }
  return Done{};
}

Problem lateFrame() {
  return {ProblemCode::deadlineExceeded, "", "The frame was not drawn before the request's deadline.", "", ""};
}

} // namespace

RenderQueue::RenderQueue(std::size_t limit)
    : jobs_(limit, [this] { renderer_.reset(); }) {} // a context must be destroyed on the thread that made it

Result<std::unique_ptr<RenderQueue>> RenderQueue::start(const RendererOptions& options, std::size_t limit) {
  std::unique_ptr<RenderQueue> queue(new RenderQueue(limit));
  std::promise<Status> started;
  Job job;
  job.deadline = Clock::time_point::max();
  job.run = [&](double) {
    try {
      auto renderer = Renderer::create(options);
      if (!renderer) {
        started.set_value(std::move(renderer).problems());
        return;
      }
      queue->renderer_ = *std::move(renderer);
      queue->info_ = queue->renderer_->info();
      queue->baker_ = queue->renderer_->baker();
      started.set_value(drawFirstFrame(*queue->renderer_));
    } catch (const std::exception& error) {
      logEvent("renderer", error.what());
      started.set_value(renderFailure());
    }
  };
  job.drop = [&](const Problem& problem) { started.set_value(problem); };
  queue->jobs_.submit(std::move(job));
  auto status = started.get_future().get();
  if (!status) {
    return std::move(status).problems();
  }
  return queue;
}

template <class T>
std::variant<T, Problems, QueueFull> RenderQueue::ask(Clock::time_point deadline, std::function<bool()> clientGone,
                                                      Work<T> work) {
  // Shared with the queue's thread, since the caller may have left before the job runs.
  struct PendingAnswer {
    std::mutex mutex;
    bool abandoned = false;
    std::promise<Result<T>> answer;
  };
  const auto pending = std::make_shared<PendingAnswer>();
  auto answer = pending->answer.get_future();
  Job queued;
  queued.deadline = deadline;
  queued.wanted = [pending, gone = std::move(clientGone)] {
    const std::lock_guard lock(pending->mutex); // who abandons it may take `gone` along
    return !pending->abandoned && !(gone && gone());
  };
  const auto goOn = [deadline, wanted = queued.wanted] { return Clock::now() < deadline && wanted(); };
  queued.run = [this, pending, goOn, work = std::move(work)](double waitedMs) {
    try {
      pending->answer.set_value(work(*renderer_, waitedMs, goOn));
    } catch (const std::exception& error) {
      logEvent("renderer", error.what());
      pending->answer.set_value(renderFailure());
    }
  };
  queued.drop = [pending](const Problem& problem) { pending->answer.set_value(problem); };
  if (auto full = jobs_.submit(std::move(queued))) {
    return *full;
  }
  if (answer.wait_until(deadline) != std::future_status::ready) {
    const std::lock_guard lock(pending->mutex);
    pending->abandoned = true;
    return Problems{lateFrame()};
  }
  auto answered = answer.get();
  if (!answered) {
    return std::move(answered).problems();
  }
  return *std::move(answered);
}

std::variant<QueuedFrame, Problems, QueueFull> RenderQueue::render(FrameJob job) {
  const auto deadline = job.deadline;
  auto work = [scene = std::move(job.scene), spec = std::move(job.spec), tiles = job.tiles, deadline](
                  Renderer& renderer, double waitedMs, const std::function<bool()>& goOn) -> Result<QueuedFrame> {
    auto frame = renderer.render(scene, spec, tiles, goOn);
    if (!frame) {
      return Clock::now() < deadline ? std::move(frame).problems() : Problems{lateFrame()};
    }
    return QueuedFrame{*std::move(frame), waitedMs};
  };
  return ask<QueuedFrame>(deadline, std::move(job.clientGone), std::move(work));
}

std::variant<double, Problems, QueueFull> RenderQueue::shimmer(ShimmerJob job) {
  const auto deadline = job.deadline;
  auto gone = std::move(job.clientGone);
  auto work = [job = std::move(job)](Renderer& renderer, double, const std::function<bool()>& goOn) -> Result<double> {
    const auto shimmer = renderer.shimmer(job.scene, job.spec, job.path, [&](double) { return goOn(); });
    if (!shimmer) {
      return shimmer.problems();
    }
    return shimmer->perThousand();
  };
  return ask<double>(deadline, std::move(gone), std::move(work));
}

bool RenderQueue::hasRoom() const {
  return jobs_.waiting() * 4 < jobs_.limit() * 3;
}

void RenderQueue::close(Clock::time_point deadline) {
  jobs_.close(deadline);
}

} // namespace gnomon

#include "server/frames/render_queue.h"

#include <exception>

#include "server/frames/first_frame.h"
#include "server/http/request_log.h"

namespace gnomon {
namespace {

Problem ownMistake() {
  return {ProblemCode::internal, "", "The server made a mistake while it rendered.", "", ""};
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
      started.set_value(drawFirstFrame(*queue->renderer_));
    } catch (const std::exception& error) {
      logEvent("renderer", error.what());
      started.set_value(ownMistake());
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
                                                      std::function<Result<T>(Renderer&, double)> work) {
  // Shared with the queue's thread: the caller may have left when the job's turn comes.
  struct Slip {
    std::mutex mutex;
    bool abandoned = false;
    std::promise<Result<T>> answer;
  };
  const auto slip = std::make_shared<Slip>();
  auto answer = slip->answer.get_future();
  Job queued;
  queued.deadline = deadline;
  queued.wanted = [slip, gone = std::move(clientGone)] {
    const std::lock_guard lock(slip->mutex);
    return !slip->abandoned && !(gone && gone());
  };
  queued.run = [this, slip, work = std::move(work)](double waitedMs) {
    try {
      slip->answer.set_value(work(*renderer_, waitedMs));
    } catch (const std::exception& error) {
      logEvent("renderer", error.what());
      slip->answer.set_value(ownMistake());
    }
  };
  queued.drop = [slip](const Problem& problem) { slip->answer.set_value(problem); };
  if (auto full = jobs_.submit(std::move(queued))) {
    return *full;
  }
  if (answer.wait_until(deadline) != std::future_status::ready) {
    const std::lock_guard lock(slip->mutex);
    slip->abandoned = true;
    return Problems{{ProblemCode::deadlineExceeded, "", "The frame took longer than a request may.", "", ""}};
  }
  auto answered = answer.get();
  if (!answered) {
    return std::move(answered).problems();
  }
  return *std::move(answered);
}

std::variant<QueuedFrame, Problems, QueueFull> RenderQueue::render(FrameJob job) {
  return ask<QueuedFrame>(job.deadline, std::move(job.clientGone),
                          [scene = std::move(job.scene), spec = std::move(job.spec), tiles = job.tiles](
                              Renderer& renderer, double waitedMs) -> Result<QueuedFrame> {
                            auto frame = renderer.render(scene, spec, tiles);
                            if (!frame) {
                              return std::move(frame).problems();
                            }
                            return QueuedFrame{*std::move(frame), waitedMs};
                          });
}

std::variant<double, Problems, QueueFull> RenderQueue::shimmer(ShimmerJob job) {
  const auto gone = job.clientGone;
  return ask<double>(job.deadline, gone, [job = std::move(job)](Renderer& renderer, double) -> Result<double> {
    const auto goOn = [&](double) { return Clock::now() < job.deadline && !(job.clientGone && job.clientGone()); };
    const auto shimmer = renderer.shimmer(job.scene, job.spec, job.path, goOn);
    if (!shimmer) {
      return shimmer.problems();
    }
    return shimmer->perThousand();
  });
}

bool RenderQueue::hasRoom() const {
  return jobs_.waiting() * 4 < jobs_.limit() * 3;
}

void RenderQueue::close(Clock::time_point deadline) {
  jobs_.close(deadline);
}

} // namespace gnomon

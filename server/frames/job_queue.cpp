#include "server/frames/job_queue.h"

#include <algorithm>
#include <cmath>

#include "protocol/base/elapsed.h"

namespace gnomon {
namespace {

Problem shuttingDown() {
  return {ProblemCode::unavailable, "", "The server is shutting down.", "", ""};
}

} // namespace

Problem QueueFull::problem() const {
  return {ProblemCode::busy, "", "The render queue is full.", std::to_string(limit) + " frames", ""};
}

int retryAfterSeconds(double jobMilliseconds, std::size_t waiting) {
  const double seconds = std::ceil(jobMilliseconds * static_cast<double>(waiting) / 1000);
  return static_cast<int>(std::clamp(seconds, 1.0, 60.0));
}

JobQueue::JobQueue(std::size_t limit, std::function<void()> atEnd)
    : limit_(limit), atEnd_(std::move(atEnd)), thread_([this] {
        work();
        if (atEnd_) {
          atEnd_();
        }
      }) {}

std::optional<QueueFull> JobQueue::submit(Job job) {
  {
    const std::lock_guard lock(mutex_);
    if (!closing_) {
      if (entries_.size() >= limit_) {
        return QueueFull{limit_, retryAfterSeconds(jobMs_, entries_.size() + 1)};
      }
      entries_.push_back({std::move(job), Clock::now()});
      changed_.notify_all();
      return std::nullopt;
    }
  }
  job.drop(shuttingDown());
  return std::nullopt;
}

void JobQueue::close(Clock::time_point deadline) {
  {
    const std::lock_guard lock(mutex_);
    if (!closing_) {
      closing_ = deadline;
    }
  }
  changed_.notify_all();
  if (thread_.joinable()) {
    thread_.join();
  }
}

std::size_t JobQueue::waiting() const {
  const std::lock_guard lock(mutex_);
  return entries_.size();
}

void JobQueue::work() {
  while (true) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closing_ || !entries_.empty(); });
    if (entries_.empty()) {
      return;
    }
    Entry entry = std::move(entries_.front());
    entries_.pop_front();
    lock.unlock();
    finish(std::move(entry));
  }
}

void JobQueue::finish(Entry entry) {
  const auto now = Clock::now();
  bool late = false;
  {
    const std::lock_guard lock(mutex_);
    late = closing_ && now >= *closing_;
  }
  if (late) {
    entry.job.drop(shuttingDown());
    return;
  }
  if (now >= entry.job.deadline || (entry.job.wanted && !entry.job.wanted())) {
    entry.job.drop(
        {ProblemCode::deadlineExceeded, "", "The request waited in the render queue until its deadline.", "", ""});
    return;
  }
  entry.job.run(millisecondsSince(entry.since));
  constexpr double kWeight = 0.2;
  const std::lock_guard lock(mutex_);
  const double took = millisecondsSince(now);
  jobMs_ = jobMs_ == 0 ? took : jobMs_ + kWeight * (took - jobMs_);
}

} // namespace gnomon

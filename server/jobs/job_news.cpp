#include "server/jobs/job_news.h"

#include <algorithm>
#include <exception>
#include <utility>

#include "server/system/log.h"

namespace gnomon {

bool isSame(const JobProgress& a, const JobProgress& b) {
  return a.state == b.state && a.done == b.done;
}

/// Whether it was news. What was found before something newer is none.
bool JobNews::Watched::see(Result<JobProgress> found) {
  const std::lock_guard lock(mutex_);
  if (found && latest_ && *latest_) {
    const JobProgress& last = **latest_;
    if (isSame(*found, last) || found->done < last.done || found->state < last.state) return false;
  }
  latest_ = std::make_shared<const Result<JobProgress>>(std::move(found));
  for (const auto& wake : wakes_) wake->raise();
  return true;
}

JobNews::JobNews(JobQueue& jobs) : jobs_(jobs), thread_([this] { look(); }) {}

JobNews::~JobNews() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

std::shared_ptr<const JobNews::Watched> JobNews::watch(const JobProgress& seen) {
  std::shared_ptr<Watched> watched;
  {
    const std::lock_guard lock(mutex_);
    Entry& entry = entries_[seen.id];
    watched = entry.watched.lock();
    if (!watched) {
      watched = std::make_shared<Watched>();
      entry = {.watched = watched};
    }
  }
  watched->see(seen);
  changed_.notify_one();
  return watched;
}

void JobNews::look() {
  std::unique_lock lock(mutex_);
  while (!stopping_) {
    auto next = Clock::time_point::max();
    for (auto entry = entries_.begin(); entry != entries_.end();) {
      if (entry->second.watched.expired()) {
        entry = entries_.erase(entry);
        continue;
      }
      if (Clock::now() >= entry->second.due) lookAt(entry->first, entry->second, lock);
      next = std::min(next, entry->second.due);
      ++entry;
    }
    if (stopping_) return;
    if (next == Clock::time_point::max()) {
      changed_.wait(lock);
    } else {
      changed_.wait_until(lock, next);
    }
  }
}

/// Entries are erased by this thread alone, so this one stays while others are added.
void JobNews::lookAt(const std::string& job, Entry& entry, std::unique_lock<std::mutex>& lock) {
  const auto watched = entry.watched.lock();
  lock.unlock();
  bool isNews = false;
  try {
    auto found = jobs_.find(job);
    if (!found) {
      isNews = watched && watched->see(found.problems());
    } else if (*found) {
      isNews = watched && watched->see(**std::move(found));
    } else if (const auto last = watched ? watched->latest() : nullptr; last && *last) {
      JobProgress cancelled = **last;
      cancelled.state = JobState::cancelled;
      isNews = watched->see(std::move(cancelled));
    }
  } catch (const std::exception& error) { // as where there is no memory; it looks again soon
    logEvent("jobs", error.what());
  }
  lock.lock();
  entry.pause = isNews ? kShortest : std::min(entry.pause * 2, kLongest);
  entry.due = Clock::now() + entry.pause;
}

} // namespace gnomon

#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "server/jobs/job_queue.h"
#include "server/system/clock.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// What becomes of jobs that replies wait for. One thread looks at each of them, however many wait for it.
class JobNews {
 public:
  explicit JobNews(JobQueue& jobs);
  ~JobNews();

  /// A job, looked at as long as a caller has this.
  class Watched {
   public:
    /// As it was last seen: at most some tenths of a second ago, unless the queue does not answer. A job that is not
    /// there any more is `cancelled`. Problem: unavailable.
    std::shared_ptr<const Result<JobProgress>> latest() const {
      const std::lock_guard lock(mutex_);
      return latest_;
    }

    /// From now on raises `news` whenever there is something newer.
    void wakeBy(const std::shared_ptr<StopSignal>& news) const {
      const std::lock_guard lock(mutex_);
      wakes_.insert(news);
    }

   private:
    friend class JobNews;
    bool see(Result<JobProgress> found);

    mutable std::mutex mutex_;
    mutable std::set<std::shared_ptr<StopSignal>> wakes_; ///< one for all replies of a server
    std::shared_ptr<const Result<JobProgress>> latest_;
  };

  /// `seen`: as the caller has just found it.
  std::shared_ptr<const Watched> watch(const JobProgress& seen);

 private:
  static constexpr std::chrono::milliseconds kShortest{20}; ///< between two looks at a job, at first and after news
  static constexpr std::chrono::milliseconds kLongest{250};
  struct Entry {
    std::weak_ptr<Watched> watched;
    Clock::time_point due = Clock::now() + kShortest;
    std::chrono::milliseconds pause = kShortest;
  };

  void look();
  void lookAt(const std::string& job, Entry& entry, std::unique_lock<std::mutex>& lock);

  JobQueue& jobs_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<std::string, Entry> entries_; ///< by the job's id
  bool stopping_ = false;
  std::thread thread_;
};

/// Whether they differ in what clients are sent.
bool isSame(const JobProgress& a, const JobProgress& b);

} // namespace gnomon

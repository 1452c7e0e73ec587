#pragma once

#include <atomic>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "protocol/base/lru.h"
#include "protocol/sequence/sequence.h"
#include "server/handlers/handlers.h"
#include "server/system/file_descriptor.h"

namespace gnomon {

/// The requests of the jobs that are drawn, read once each.
class JobSequences {
 public:
  explicit JobSequences(JobQueue& jobs) : jobs_(jobs) {}

  /// nullptr where the job is gone. Problem: unavailable.
  Result<std::shared_ptr<const Sequence>> of(const std::string& job);

 private:
  static constexpr std::size_t kMost = 16;
  struct Entry {
    std::string job;
    std::shared_ptr<const Sequence> sequence;
  };

  JobQueue& jobs_;
  std::mutex mutex_;
  LruList<Entry> entries_;
};

/// The frames that a server has taken and not given back, renewed by a thread of their own whatever those that draw
/// them wait for: a scene from the store, a worker, room for the pictures. So a short lease means that the server has
/// died.
class HeldFrames {
 public:
  HeldFrames(JobQueue& jobs, std::chrono::milliseconds lease);
  ~HeldFrames(); ///< none is held any more

  /// One of them, as long as this lives.
  class Held {
   public:
    Held(HeldFrames& frames, const FrameTurn& turn);
    ~Held();
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    bool isWanted() const { return entry_->isWanted; } ///< false = its job was removed or has failed

   private:
    friend class HeldFrames;
    struct Entry {
      explicit Entry(const FrameTurn& held) : turn(held) {}
      FrameTurn turn;
      std::atomic<bool> isWanted = true;
    };
    HeldFrames& frames_;
    std::shared_ptr<Entry> entry_;
  };

 private:
  void renew();

  JobQueue& jobs_;
  const std::chrono::milliseconds pause_;
  StopSignal stop_;
  std::mutex mutex_;
  std::list<std::shared_ptr<Held::Entry>> held_;
  std::thread thread_;
};

/// Threads that take frames of jobs and have workers draw them, until the server drains.
class JobRunners {
 public:
  /// `threads`: frames at once. `services` outlives them.
  JobRunners(Services& services, std::size_t threads);
  ~JobRunners(); ///< gives back what is in work

 private:
  void takeFrames();
  void draw(const FrameTurn& turn);
  void keep(const FrameTurn& turn, const JobFrame& frame);
  void fail(const FrameTurn& turn, const Problems& problems);
  void giveBack(const FrameTurn& turn, bool isTried);
  void say(const Problems& problems);
  void queueIsThere();
  void count(FrameEnd end) { services_.jobFrames.add(end); }
  bool stopping() const { return stop_.raised() || services_.draining; }

  Services& services_;
  JobSequences sequences_;
  HeldFrames held_;
  StopSignal stop_;
  std::mutex saying_;
  std::string said_; ///< why the queue can't be reached; empty = it can
  std::vector<std::thread> threads_;
};

} // namespace gnomon

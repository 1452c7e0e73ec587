#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gnomon {

/// Threads that run a task at once or not at all: no list of waiting tasks can grow. Of idle threads the one that ran
/// last runs next, so that no more of them than work at once keep stacks and heaps of their own in memory.
class WorkerPool {
 public:
  /// Throws std::system_error where the system refuses a thread; none of the others is left then.
  explicit WorkerPool(std::size_t threads);
  ~WorkerPool() { shutdown(); }

  /// Whether a task would run. It stays true until the next tryRun() or shutdown().
  bool hasIdle();

  /// Whether a task runs, or will.
  bool isBusy();

  /// False, and the task does not run, where every thread is busy. Tasks must not throw.
  bool tryRun(const std::function<void()>& task);

  /// Runs what was accepted and joins the threads.
  void shutdown();

 private:
  struct Worker {
    std::condition_variable changed;
    std::function<void()> task; ///< accepted, and not begun yet
  };
  void work(Worker& own);

  std::mutex mutex_;
  std::deque<Worker> workers_;
  std::vector<Worker*> idle_; ///< the one that ran last at the end
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

} // namespace gnomon

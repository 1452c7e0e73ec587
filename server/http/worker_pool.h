#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gnomon {

/// Threads that run tasks at once or not at all: there is no waiting list to grow.
class WorkerPool {
 public:
  explicit WorkerPool(std::size_t threads);
  ~WorkerPool() { shutdown(); }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// False, and the task is left alone, when every thread is taken. Tasks must not throw.
  bool tryRun(const std::function<void()>& task);

  /// Runs what was accepted and joins the threads. Once.
  void shutdown();

 private:
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::size_t idle_ = 0; ///< threads without a task; each accepted task has one
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

} // namespace gnomon

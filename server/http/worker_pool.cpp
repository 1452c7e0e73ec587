#include "server/http/worker_pool.h"

#include <system_error>
#include <utility>

namespace gnomon {

WorkerPool::WorkerPool(std::size_t threads) : workers_(threads) {
  for (Worker& worker : workers_) idle_.push_back(&worker);
  threads_.reserve(threads);
  try {
    for (Worker& worker : workers_) {
      threads_.emplace_back([this, &worker] { work(worker); });
    }
  } catch (const std::system_error&) {
    shutdown();
    throw;
  }
}

bool WorkerPool::hasIdle() {
  const std::lock_guard lock(mutex_);
  return !stopping_ && !idle_.empty();
}

bool WorkerPool::isBusy() {
  const std::lock_guard lock(mutex_);
  return idle_.size() < workers_.size();
}

bool WorkerPool::tryRun(const std::function<void()>& task) {
  const std::lock_guard lock(mutex_);
  if (stopping_ || idle_.empty()) return false;
  Worker& worker = *idle_.back();
  worker.task = task;
  idle_.pop_back();
  worker.changed.notify_one();
  return true;
}

void WorkerPool::shutdown() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
    for (Worker& worker : workers_) worker.changed.notify_one();
  }
  for (std::thread& thread : threads_) {
    thread.join();
  }
  threads_.clear();
}

void WorkerPool::work(Worker& own) {
  std::unique_lock lock(mutex_);
  while (true) {
    own.changed.wait(lock, [&] { return stopping_ || own.task; });
    if (!own.task) return;
    std::function<void()> task = std::exchange(own.task, nullptr);
    lock.unlock();
    task();
    task = nullptr;
    lock.lock();
    idle_.push_back(&own);
  }
}

} // namespace gnomon

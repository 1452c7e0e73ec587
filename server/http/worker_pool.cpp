#include "server/http/worker_pool.h"

namespace gnomon {

WorkerPool::WorkerPool(std::size_t threads) : idle_(threads) {
  threads_.reserve(threads);
  for (std::size_t i = 0; i < threads; ++i) {
    threads_.emplace_back([this] { work(); });
  }
}

bool WorkerPool::tryRun(const std::function<void()>& task) {
  {
    const std::lock_guard lock(mutex_);
    if (stopping_ || idle_ == 0) {
      return false;
    }
    tasks_.push_back(task);
    --idle_;
  }
  changed_.notify_one();
  return true;
}

void WorkerPool::shutdown() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& thread : threads_) {
    thread.join();
  }
  threads_.clear();
}

void WorkerPool::work() {
  while (true) {
    std::function<void()> task;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
      if (tasks_.empty()) {
        return;
      }
      task = std::move(tasks_.front());
      tasks_.pop_front();
    }
    task();
    const std::lock_guard lock(mutex_);
    ++idle_;
  }
}

} // namespace gnomon

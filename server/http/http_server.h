#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/http/connection.h"

namespace gnomon {

struct HttpServerOptions {
  std::string bind = "127.0.0.1";
  int port = 0;              ///< 0 = any free one
  std::size_t threads = 128; ///< connections served at once; beyond them only probes are answered, all else gets 503
};

/// Listens, accepts, and hands connections to threads.
class HttpServer {
 public:
  /// Listening once it returns; nothing is accepted before run(). `context` outlives the server.
  static Result<std::unique_ptr<HttpServer>> listen(const HttpServerOptions& options, ConnectionContext& context);
  ~HttpServer();

  int port() const;

  /// Serves until stop(), and returns when every accepted request is answered. False: accepting failed.
  bool run();

  /// No further connection is accepted and no further request read. Any thread, any time.
  void stop();

 private:
  struct Impl;
  explicit HttpServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// Threads that run a task at once or not at all: no list of waiting tasks can grow. Of idle threads the one that ran
/// last runs next, so that no more of them than work at once keep stacks and heaps of their own in memory.
class WorkerPool {
 public:
  explicit WorkerPool(std::size_t threads);
  ~WorkerPool() { shutdown(); }
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  /// False, and the task does not run, where every thread is busy. Tasks must not throw.
  bool tryRun(const std::function<void()>& task);

  /// Runs what was accepted and joins the threads. Once.
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

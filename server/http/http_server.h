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

/// Threads that run a task at once or not at all: no list of waiting tasks can grow.
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
  void work();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  std::size_t idle_ = 0; ///< threads without a task; each accepted task has one
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

} // namespace gnomon

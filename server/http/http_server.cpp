#include "server/http/http_server.h"

#include <atomic>
#include <httplib.h>
#include <system_error>
#include <utility>

#include "server/http/overflow_lane.h"

namespace gnomon {
namespace {

constexpr int kBacklog = 512; ///< connections that the kernel holds until they are accepted

/// True on the accepting thread while it runs a connection for which no worker was free.
thread_local bool overflowing = false;

/// Runs a connection on a worker, or at once, marked as overflowing.
class ConnectionQueue : public httplib::TaskQueue {
 public:
  explicit ConnectionQueue(WorkerPool& pool) : pool_(pool) {}

  void enqueue(std::function<void()> connection) override {
    if (!pool_.tryRun(connection)) {
      overflowing = true;
      connection();
      overflowing = false;
    }
  }

  void shutdown() override { pool_.shutdown(); }

 private:
  WorkerPool& pool_;
};

/// Everything that the server uses of cpp-httplib 0.11:
/// - bind_to_port, bind_to_any_port, set_socket_options, and the listening socket svr_sock_;
/// - listen_after_bind, the loop that accepts connections, and TaskQueue, which receives each of them;
/// - process_and_close_socket, overridden, so that connection.h serves it instead of the library's parser. That one
///   buffers header lines and chunked bodies without a bound, matches routes and ranges with recursive regular
///   expressions, and waits for slow clients for ever.
class Listener : public httplib::Server {
 public:
  Listener(ConnectionContext& context, std::size_t threads) : context_(context), overflow_(context), pool_(threads) {
    new_task_queue = [this] { return new ConnectionQueue(pool_); };
    set_socket_options([](socket_t socket) {
      const int yes = 1;
      setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes,
                 sizeof yes); // not REUSEPORT: two servers must not share a port
    });
  }

  bool deepenBacklog() { return ::listen(svr_sock_, kBacklog) == 0; }

  /// accept() fails from now on, also where it is not called yet; the library's own stop() would miss that case.
  void shut() { ::shutdown(svr_sock_, SHUT_RDWR); }

  int boundPort() const {
    sockaddr_storage address{};
    socklen_t length = sizeof address;
    if (::getsockname(svr_sock_, reinterpret_cast<sockaddr*>(&address), &length) != 0) {
      return 0;
    }
    return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<const sockaddr_in6&>(address).sin6_port
                                               : reinterpret_cast<const sockaddr_in&>(address).sin_port);
  }

 private:
  bool process_and_close_socket(socket_t fd) override {
    FileDescriptor socket(fd);
    const int yes = 1;
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
    if (overflowing) {
      overflow_.adopt(std::move(socket));
    } else {
      serveConnection(std::move(socket), context_);
    }
    return true;
  }

  ConnectionContext& context_;
  OverflowLane overflow_;
  WorkerPool pool_;
};

} // namespace

struct HttpServer::Impl {
  Impl(ConnectionContext& shared, std::size_t threads) : context(shared), listener(shared, threads) {}

  ConnectionContext& context;
  Listener listener;
  int port = 0;
  std::atomic<bool> stopped = false;
};

HttpServer::HttpServer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
HttpServer::~HttpServer() = default;

Result<std::unique_ptr<HttpServer>> HttpServer::listen(const HttpServerOptions& options, ConnectionContext& context) {
  std::unique_ptr<Impl> impl;
  try {
    impl = std::make_unique<Impl>(context, options.threads);
  } catch (const std::system_error&) {
    return Problem{ProblemCode::unavailable, "", "The system does not allow this process so many threads.", "",
                   std::to_string(options.threads)};
  }
  const bool bound = options.port == 0 ? impl->listener.bind_to_any_port(options.bind) > 0
                                       : impl->listener.bind_to_port(options.bind, options.port);
  if (!bound || !impl->listener.deepenBacklog()) {
    return Problem{ProblemCode::unavailable, "",
                   "The server can't listen on this address. It is in use, or does not belong to this machine.", "",
                   options.bind + ":" + std::to_string(options.port)};
  }
  impl->port = impl->listener.boundPort();
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(impl)));
}

int HttpServer::port() const {
  return impl_->port;
}

bool HttpServer::run() {
  impl_->listener.listen_after_bind();
  return impl_->stopped;
}

void HttpServer::stop() {
  if (!impl_->stopped.exchange(true)) {
    impl_->context.stop.raise();
    impl_->listener.shut();
  }
}

WorkerPool::WorkerPool(std::size_t threads) : workers_(threads) {
  for (Worker& worker : workers_) idle_.push_back(&worker);
  threads_.reserve(threads);
  for (Worker& worker : workers_) {
    threads_.emplace_back([this, &worker] { work(worker); });
  }
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

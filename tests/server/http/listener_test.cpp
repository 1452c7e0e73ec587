#include <arpa/inet.h>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <future>
#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <optional>
#include <set>
#include <sys/socket.h>
#include <thread>

#include "server/http/http_server.h"
#include "server/http/worker_pool.h"

namespace gnomon {
namespace {

/// Empty where it is refused.
FileDescriptor connected(int port) {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    socket.reset();
  }
  return socket;
}

int optionOf(const FileDescriptor& socket, int level, int option) {
  int value = 0;
  socklen_t length = sizeof value;
  EXPECT_EQ(::getsockopt(socket.get(), level, option, &value, &length), 0);
  return value;
}

TEST(Listener, AConnectionKnowsItsClientAndNoticesWhenItVanishes) {
  auto listener = Listener::open("127.0.0.1", 0);
  ASSERT_TRUE(listener);
  StopSignal stop;
  std::optional<OpenConnection> accepted;
  const int port = listener->port();
  const FileDescriptor client = connected(port);
  EXPECT_TRUE(listener->run(
      stop,
      [&](OpenConnection connection) {
        accepted = std::move(connection);
        stop.raise();
      },
      [] {}));
  EXPECT_FALSE(connected(port)) << "and after its end nobody is";
  ASSERT_TRUE(accepted);
  EXPECT_EQ(accepted->peer.text, "127.0.0.1");
  EXPECT_EQ(optionOf(accepted->socket, SOL_SOCKET, SO_KEEPALIVE), 1);
  EXPECT_EQ(optionOf(accepted->socket, IPPROTO_TCP, TCP_USER_TIMEOUT), 20'000);
}

TEST(Listener, RefusesAnAddressThatIsTakenOrForeign) {
  const auto listener = Listener::open("127.0.0.1", 0);
  ASSERT_TRUE(listener);
  EXPECT_FALSE(Listener::open("127.0.0.1", listener->port()));
  EXPECT_FALSE(Listener::open("192.0.2.1", 0));
  EXPECT_FALSE(Listener::open("no address", 0));
}

TEST(Listener, OneConnectionsFailureIsNotItsOwn) {
  for (const int error : {ECONNABORTED, EINTR, EAGAIN, EPERM, EPROTO, ENETDOWN, EHOSTUNREACH}) {
    EXPECT_EQ(afterAccept(error), AfterAccept::next) << error;
  }
  for (const int error : {EMFILE, ENFILE, ENOBUFS, ENOMEM}) {
    EXPECT_EQ(afterAccept(error), AfterAccept::pause) << error;
  }
  for (const int error : {EBADF, EINVAL, ENOTSOCK}) {
    EXPECT_EQ(afterAccept(error), AfterAccept::giveUp) << error;
  }
}

TEST(WorkerPool, RefusesWhenEveryThreadIsTaken) {
  WorkerPool pool(2);
  std::promise<void> release;
  const auto released = release.get_future().share();
  std::atomic<int> refusedRuns = 0;
  EXPECT_TRUE(pool.tryRun([released] { released.wait(); }));
  EXPECT_TRUE(pool.tryRun([released] { released.wait(); }));
  EXPECT_FALSE(pool.tryRun([&] { ++refusedRuns; }));
  release.set_value();
  pool.shutdown();
  EXPECT_EQ(refusedRuns, 0);
  EXPECT_FALSE(pool.tryRun([&] { ++refusedRuns; }));
}

TEST(WorkerPool, RunsWhatItAcceptedBeforeItEnds) {
  std::atomic<int> runs = 0;
  int accepted = 0;
  {
    WorkerPool pool(4);
    for (int i = 0; i < 100; ++i) {
      accepted += pool.tryRun([&] { ++runs; }) ? 1 : 0;
    }
  }
  EXPECT_EQ(runs, accepted);
  EXPECT_GE(accepted, 4);
}

TEST(WorkerPool, TasksOneAfterTheOtherKeepToFewThreads) {
  WorkerPool pool(16);
  std::set<std::thread::id> threads;
  for (int i = 0; i < 100; ++i) {
    std::promise<std::thread::id> ran;
    ASSERT_TRUE(pool.tryRun([&ran] { ran.set_value(std::this_thread::get_id()); }));
    threads.insert(ran.get_future().get());
    std::this_thread::sleep_for(std::chrono::milliseconds(1)); // it is idle again, or very nearly so
  }
  EXPECT_LE(threads.size(), 4u);
}

} // namespace
} // namespace gnomon

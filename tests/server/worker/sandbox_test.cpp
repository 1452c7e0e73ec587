#include "server/worker/sandbox.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <functional>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "tests/server/worker/escapes.h"

namespace gnomon {
namespace {

/// What `attempt` gives in a sealed process: its own number, below 100, or 100 where sealing failed.
int sealed(Seal kind, const std::function<int()>& attempt, std::uint64_t memoryBytes = 0) {
  const pid_t child = ::fork();
  if (child == 0) {
    const bool done = bool(seal(kind, memoryBytes));
    ::_exit(done ? attempt() : 100);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 200 + WTERMSIG(status);
}

/// Files of the user that no worker needs.
class Secret {
 public:
  Secret() {
    const int file = ::mkstemp(path_.data());
    EXPECT_GE(file, 0);
    ::close(file);
  }
  ~Secret() { ::unlink(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_ = "/tmp/gnomon_sandbox_test_XXXXXX";
};

/// Whether an escape succeeds in a process that is confined and sealed as a worker is. 100 and more: it could not be.
int escapeFrom(Seal kind, const Escape& escape, const std::string& secret) {
  const pid_t front = ::getpid();
  const pid_t child = ::fork();
  if (child == 0) {
    const auto confined = confineFiles();
    if (!confined || !seal(kind, 0)) ::_exit(100);
    if (escape.keeper == Escape::landlock && kind == Seal::drivers && !*confined) ::_exit(101);
    ::_exit(succeeds(escape, front, secret) ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 200 + WTERMSIG(status);
}

TEST(Sandbox, WhatATakenOverWorkerTriesIsRefused) {
  const Secret secret;
  for (const Escape& escape : escapes()) {
    EXPECT_EQ(escapeFrom(Seal::full, escape, secret.path()), 0) << escape.what;
    if (escape.keeper == Escape::fullSeal) {
      EXPECT_EQ(escapeFrom(Seal::drivers, escape, secret.path()), 1) << escape.what << ": drivers need it";
    } else if (const int result = escapeFrom(Seal::drivers, escape, secret.path()); result != 101) {
      EXPECT_EQ(result, 0) << escape.what;
    }
  }
}

TEST(Sandbox, NoneOfThatIsRefusedToOthers) {
  const Secret secret;
  const pid_t front = ::getpid();
  for (const Escape& escape : escapes()) {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(succeeds(escape, front, secret.path()) ? 1 : 0);
    int status = 0;
    ::waitpid(child, &status, 0);
    const bool mayBeSwitchedOff = std::string_view(escape.what) == "queue calls";
    EXPECT_TRUE(mayBeSwitchedOff || WEXITSTATUS(status) == 1) << escape.what;
  }
}

TEST(Sandbox, AProcessThatIsNotDumpableIsClosedToItsUser) {
  ASSERT_EQ(::prctl(PR_SET_DUMPABLE, 0), 0); // as the front is
  const Secret secret;
  for (const Escape& escape : escapes()) {
    const std::string_view what = escape.what;
    if (what != "read variables" && what != "change memory") continue;
    EXPECT_EQ(sealed(Seal::drivers, [&] { return succeeds(escape, ::getppid(), secret.path()) ? 1 : 0; }), 0) << what;
  }
  ::prctl(PR_SET_DUMPABLE, 1);
}

TEST(Sandbox, HoldsForEveryThread) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::array<int, 2> go{};
    if (::pipe(go.data()) != 0) ::_exit(2);
    int refused = 1;
    std::thread older([&] { // runs before the seal
      char byte = 0;
      if (::read(go[0], &byte, 1) == 1) refused = ::socket(AF_INET, SOCK_STREAM, 0) < 0 && errno == EPERM ? 0 : 1;
    });
    if (!seal(Seal::full, 0)) ::_exit(100);
    [[maybe_unused]] const auto written = ::write(go[1], "x", 1);
    older.join();
    ::_exit(refused);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(Sandbox, LeavesWhatDrawingTakes) {
  EXPECT_EQ(sealed(Seal::full,
                   [] {
                     int sum = 0;
                     std::thread([&] { sum = 7; }).join();
                     std::vector<char> memory(100 << 20, 'x');
                     const int file = ::memfd_create("x", 0);
                     const bool written = ::write(file, memory.data(), 100) == 100;
                     return sum == 7 && written && memory.back() == 'x' ? 0 : 1;
                   }),
            0);
  EXPECT_EQ(sealed(Seal::full,
                   [] {
                     std::abort();
                     return 0;
                   }),
            200 + SIGABRT);
}

TEST(Sandbox, BoundsMemory) {
  if (!allocationsAreBounded()) GTEST_SKIP() << "the address sanitizer allocates what no limit would allow";
  EXPECT_EQ(sealed(
                Seal::full,
                [] {
                  try {
                    std::vector<char> memory(std::size_t{2} << 30, 'x');
                    return memory.empty() ? 2 : 1;
                  } catch (const std::bad_alloc&) {
                    return 0;
                  }
                },
                std::uint64_t{1} << 30),
            0);
}

} // namespace
} // namespace gnomon

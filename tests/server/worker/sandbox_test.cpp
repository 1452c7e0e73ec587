#include "server/worker/sandbox.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

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

/// 0 where a call failed as not permitted.
int isRefused(long result) {
  return result < 0 && errno == EPERM ? 0 : 1;
}

struct Attempt {
  const char* what;
  std::function<int()> run;
};

TEST(Sandbox, RefusesWhatAWorkerNeverNeeds) {
  const std::array attempts{
      Attempt{"execute a program", [] { return isRefused(::execl("/bin/true", "true", nullptr)); }},
      Attempt{"start a process", [] { return isRefused(::fork()); }},
      Attempt{"start a program",
              [] {
                pid_t pid = 0;
                std::array<char*, 1> none{nullptr};
                return ::posix_spawn(&pid, "/bin/true", nullptr, nullptr, none.data(), none.data()) == EPERM ? 0 : 1;
              }},
      Attempt{"open a socket", [] { return isRefused(::socket(AF_INET, SOCK_STREAM, 0)); }},
      Attempt{"open a local socket", [] { return isRefused(::socket(AF_UNIX, SOCK_STREAM, 0)); }},
      Attempt{"connect",
              [] {
                sockaddr_in address{};
                return isRefused(::connect(0, reinterpret_cast<const sockaddr*>(&address), sizeof address));
              }},
      Attempt{"signal another process", [] { return isRefused(::kill(::getppid(), 0)); }},
      Attempt{"look into another process",
              [] { return isRefused(::ptrace(PTRACE_ATTACH, ::getppid(), nullptr, nullptr)); }},
      Attempt{"raise its limits",
              [] {
                const rlimit more{RLIM_INFINITY, RLIM_INFINITY};
                return isRefused(::setrlimit(RLIMIT_NOFILE, &more));
              }},
      Attempt{"change who it is", [] { return isRefused(::setuid(0)); }},
      Attempt{"trace system calls anew", [] { return isRefused(::prctl(PR_SET_SECCOMP, 1, 0, 0, 0)); }},
  };
  for (const Seal kind : {Seal::full, Seal::drivers}) {
    for (const Attempt& attempt : attempts) EXPECT_EQ(sealed(kind, attempt.run), 0) << attempt.what;
  }
}

TEST(Sandbox, OpensNoFileUnlessDriversMay) {
  const auto reading = [] { return isRefused(::open("/etc/hostname", O_RDONLY)); };
  const auto writing = [] { return isRefused(::open("/tmp/gnomon-sandbox-test", O_WRONLY | O_CREAT, 0600)); };
  const auto removing = [] { return isRefused(::unlink("/tmp/gnomon-sandbox-test")); };
  EXPECT_EQ(sealed(Seal::full, reading), 0);
  EXPECT_EQ(sealed(Seal::full, writing), 0);
  EXPECT_EQ(sealed(Seal::full, removing), 0);
  EXPECT_EQ(sealed(Seal::drivers, reading), 1);
}

TEST(Sandbox, HoldsForEveryThread) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::array<int, 2> go{};
    if (::pipe(go.data()) != 0) ::_exit(2);
    int refused = 1;
    std::thread older([&] { // runs before the seal
      char byte = 0;
      if (::read(go[0], &byte, 1) == 1) refused = isRefused(::socket(AF_INET, SOCK_STREAM, 0));
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

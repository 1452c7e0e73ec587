#include "server/worker/sandbox.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "renderer/core/file_access.h"
#include "renderer/core/system_calls.h"
#include "tests/server/worker/escapes.h"

namespace gnomon {
namespace {

/// What a process gives that does this; 200 and more: a signal ended it.
int endOf(const std::function<int()>& process) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(process());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 200 + WTERMSIG(status);
}

/// What `attempt` gives in a sealed process: its own number, below 100, or 100 where sealing failed.
int sealed(Seal kind, const std::function<int()>& attempt, std::uint64_t memoryBytes = 0) {
  return endOf([&] { return seal(kind, memoryBytes) ? attempt() : 100; });
}

/// What a worker gives whose front has no rights that others of its user lack, so that none of these refuses anything.
int ofWorker(const std::function<int(pid_t front)>& worker) {
  return endOf([&] {
    if (dropPrivileges() != 0) return 100;
    const pid_t front = ::getpid();
    return endOf([&] { return worker(front); });
  });
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
  return ofWorker([&](pid_t front) {
    const auto confined = confineFiles();
    if (!confined || !seal(kind, 0)) return 100;
    if (escape.keeper == Escape::landlock && kind == Seal::drivers && !*confined) return 101;
    return succeeds(escape, front, secret) ? 1 : 0;
  });
}

/// Containers refuse the call altogether, even of a process with itself.
bool mayCompareFiles() {
  return ::syscall(SYS_kcmp, ::getpid(), ::getpid(), 0, 0, 0) == 0;
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

/// Whether an escape succeeds in a process that keeps the calls of a duty; 100 where it could not give up others.
int escapeOnDuty(Duty duty, const Escape& escape, const std::string& secret) {
  return ofWorker([&](pid_t front) {
    if (keepSystemCalls(duty) != 0) return 100;
    return succeeds(escape, front, secret) ? 1 : 0;
  });
}

TEST(Sandbox, TheReaderOfVdbFilesAndWhatStartsItGetNoFurther) {
  const Secret secret;
  // The one starts a process and its libraries. Which files it reads is not for its calls to say.
  const std::set<std::string_view> starting{"start a process", "map code", "make memory code"};
  for (const Escape& escape : escapes()) {
    EXPECT_EQ(escapeOnDuty(Duty::compute, escape, secret.path()), 0) << escape.what;
    const std::string_view what = escape.what;
    const bool isOpening = (escape.keeper == Escape::landlock || what == "read a library") && what.find("change") != 0;
    if (starting.contains(what) || isOpening) continue;
    EXPECT_EQ(escapeOnDuty(Duty::start, escape, secret.path()), 0) << escape.what;
  }
}

TEST(Sandbox, WhatStartsTheReaderStartsNothingElse) {
  const auto isRefused = [](long result) { return result == -1 && (errno == EPERM || errno == EACCES); };
  const std::array<char*, 1> none{nullptr};
  const auto execute = [&](int file, const char* path) {
    return ::syscall(SYS_execveat, file, path, none.data(), none.data(), AT_EMPTY_PATH);
  };
  const int result = endOf([&] {
    const int program = ::open("/bin/true", O_PATH | O_CLOEXEC), other = ::open("/bin/false", O_PATH | O_CLOEXEC);
    const std::array grants{FileGrant{"/bin/true", FileUse::readAndStart},
                            FileGrant{"/lib64/ld-linux-x86-64.so.2", FileUse::readAndStart},
                            FileGrant{"/lib/ld-linux-aarch64.so.1", FileUse::readAndStart}, FileGrant{"/lib"},
                            FileGrant{"/etc/ld.so.cache"}};
    ::dup3(program, kProgram, O_CLOEXEC);
    dropPrivileges();
    const bool hasFiles = keepFiles(grants) == 0; // else a path is not refused
    int wrong = keepSystemCalls(Duty::start) != 0 ? 1 : 0;
    if (!isRefused(execute(other, ""))) wrong |= 2;
    if (hasFiles && !isRefused(execute(kProgram, "/bin/false"))) wrong |= 4;
    if (!isRefused(::dup2(other, kProgram))) wrong |= 8;
    if (!isRefused(::close(kProgram))) wrong |= 16;
    if (!isRefused(::execve("/bin/true", none.data(), none.data()))) wrong |= 32;
    if (wrong == 0) execute(kProgram, "");
    return 64 | wrong;
  });
  EXPECT_EQ(result, 0) << "its own program runs, and it alone";
}

TEST(Sandbox, NoneOfThatIsRefusedToOthersOfTheUser) {
  const Secret secret;
  for (const Escape& escape : escapes()) {
    const int result = ofWorker([&](pid_t front) { return succeeds(escape, front, secret.path()) ? 1 : 0; });
    // The one may be switched off, and the other meets processes of root that have more rights.
    const std::string_view what = escape.what;
    if (what == "queue calls" || what == "set the user's priority") continue;
    if (what == "compare files" && !mayCompareFiles()) continue;
    EXPECT_EQ(result, 1) << escape.what;
  }
  if (!mayCompareFiles())
    GTEST_SKIP() << "the system refuses kcmp(2), as containers do: \"compare files\" shows nothing";
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

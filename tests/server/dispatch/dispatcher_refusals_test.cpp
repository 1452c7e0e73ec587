// What the system refuses the dispatcher, and what is thrown in it: one task's problem, or one worker's end.
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <sys/wait.h>
#include <system_error>
#include <thread>

#include "tests/server/dispatch/dispatcher_fixture.h"

namespace gnomon {
namespace {

using testing::DispatcherTest;
using testing::kStays;

/// A store that can't say what it has.
class BrokenLightMaps : public StoredLightMaps {
 public:
  FileDescriptor open(const std::string&) override { throw std::runtime_error("This store is broken."); }
  void write(const std::string&, const FileDescriptor&) override {}
  void removeScene(const std::string&) override {}
  void cleanUp() override {}
};

TEST_F(DispatcherTest, ATaskThatCannotBeSentIsAProblemAndOthersGoOn) {
  std::atomic<bool> throws = true;
  const auto dispatcher = start(1, {.waited = [&](Lane, double) {
                                  if (throws) throw std::runtime_error("Nobody counts.");
                                }});
  const pid_t worker = dispatcher->processes().at(0);
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "internal");
  EXPECT_EQ(dispatcher->state().waiting + dispatcher->state().running, 0u);
  throws = false;
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
  EXPECT_EQ(dispatcher->processes().at(0), worker);
}

/// Workers that write down which process they are, so that a test can kill one while the dispatcher is held up.
class KnownWorkers {
 public:
  KnownWorkers() {
    std::ofstream(program_) << "#!/bin/sh\necho $$ > " << pid_ << "\nexec " << GNOMON_FAULTY_WORKER << " \"$@\"\n";
    std::filesystem::permissions(program_, std::filesystem::perms::owner_all);
  }
  ~KnownWorkers() { std::filesystem::remove_all(folder_); }
  KnownWorkers(const KnownWorkers&) = delete;
  KnownWorkers& operator=(const KnownWorkers&) = delete;

  const std::string& program() const { return program_; }

  /// Ends the newest, and waits until its channel is closed. False where it is gone.
  bool killNewest() const {
    pid_t worker = 0;
    std::ifstream(pid_) >> worker;
    siginfo_t ended{};
    return ::kill(worker, SIGKILL) == 0 && ::waitid(P_PID, worker, &ended, WEXITED | WNOWAIT) == 0;
  }

 private:
  std::string folder_ = [] {
    std::string pattern = ::testing::TempDir() + "workers.XXXXXX";
    return std::string(::mkdtemp(pattern.data()));
  }();
  std::string program_ = folder_ + "/worker", pid_ = folder_ + "/pid";
};

TEST_F(DispatcherTest, ATaskIsNotToBlameForWorkersThatEndBeforeTheyHaveIt) {
  constexpr int kEnds = 6; // more than a task's workers may
  const KnownWorkers workers;
  std::atomic<int> ends = 0;
  const auto dispatcher = start(1, {.program = workers.program(), .waited = [&](Lane, double) {
                                      if (ends < kEnds && workers.killNewest()) ++ends;
                                    }});
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
  EXPECT_EQ(ends, kEnds);
  EXPECT_EQ(dispatcher->state().replacements, (std::array<std::uint64_t, kWorkerEnds>{kEnds, 0, 0, 0}))
      << "nobody is said to have been silent";
}

TEST_F(DispatcherTest, WhatIsThrownOverAMessageCostsTheWorkerThatSentItAndNotTheServer) {
  const auto dispatcher =
      start(1, {.each = {.keepsLightMaps = true}, .lightMaps = std::make_shared<BrokenLightMaps>()});
  Task baked = frame();
  baked.request =
      R"({"width": 16, "height": 16, "shadow": {"technique": "lightMap", "lightMap": {"size": 32, "samples": 16}}})";
  EXPECT_EQ(problemOf(dispatcher->run(baked, kStays)), "internal");
  EXPECT_EQ(problemOf(dispatcher->run(frame(), kStays)), "");
  EXPECT_EQ(dispatcher->state().replacements, (std::array<std::uint64_t, kWorkerEnds>{2, 0, 0, 0}));
}

TEST(Dispatcher, SaysThatThereIsNoThreadForItsWorkers) {
  for (int threads = 0; threads < 2; ++threads) {
    DispatcherOptions options{.program = GNOMON_FAULTY_WORKER};
    options.each.device = DeviceChoice::cpu;
    options.startThread = [left = threads](std::function<void()> work) mutable {
      if (left-- == 0) throw std::system_error(EAGAIN, std::generic_category());
      return std::thread(std::move(work));
    };
    const auto started = Dispatcher::start(options);
    ASSERT_FALSE(started) << threads;
    EXPECT_EQ(started.problems()[0].code, ProblemCode::unavailable);
  }
}

TEST(Dispatcher, SaysWhyNoWorkerCanStart) {
  const auto missing = Dispatcher::start({.program = "/nowhere/gnomon"});
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.problems()[0].code, ProblemCode::unavailable);
  const auto other = Dispatcher::start({.program = "/bin/false"});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.problems()[0].code, ProblemCode::backend);
}

} // namespace
} // namespace gnomon

#include "server/process/signals.h"

#include <array>
#include <csignal>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace gnomon {
namespace {

struct Pipe {
  FileDescriptor read, write;
};

Pipe openPipe() {
  std::array<int, 2> ends{};
  if (::pipe(ends.data()) != 0) return {};
  return {FileDescriptor(ends[0]), FileDescriptor(ends[1])};
}

constexpr Clock::time_point kNow{};

/// On a thread of its own, since signals stay blocked for the thread that makes a Signals.
template <typename Test>
void onThread(Test test) {
  std::thread(test).join();
}

TEST(Signals, APipeThatIsClosedIsToldOnce) {
  onThread([] {
    Pipe pipe = openPipe();
    Signals signals(nullptr, std::move(pipe.read));
    const StopSignal done;
    EXPECT_EQ(signals.wait(done, kNow), Signals::Event::timeout);
    pipe.write.reset();
    EXPECT_EQ(signals.wait(done, Clock::time_point::max()), Signals::Event::abandoned);
    EXPECT_EQ(signals.wait(done, kNow), Signals::Event::timeout);
  });
}

TEST(Signals, WhatIsWrittenIntoThePipeIsDropped) {
  onThread([] {
    Pipe pipe = openPipe();
    Signals signals(nullptr, std::move(pipe.read));
    const StopSignal done;
    const std::array<char, 10'000> text{};
    ASSERT_EQ(::write(pipe.write.get(), text.data(), text.size()), static_cast<ssize_t>(text.size()));
    EXPECT_EQ(signals.wait(done, Clock::now() + std::chrono::milliseconds(50)), Signals::Event::timeout);
    pipe.write.reset();
    EXPECT_EQ(signals.wait(done, Clock::time_point::max()), Signals::Event::abandoned);
  });
}

TEST(Signals, ASignalIsToldWithOrWithoutAPipe) {
  for (const bool hasPipe : {false, true}) {
    onThread([hasPipe] {
      Pipe pipe = openPipe();
      Signals signals(nullptr, hasPipe ? std::move(pipe.read) : FileDescriptor());
      const StopSignal done;
      ::pthread_kill(::pthread_self(), SIGTERM);
      EXPECT_EQ(signals.wait(done, Clock::time_point::max()), Signals::Event::signal);
      EXPECT_EQ(signals.wait(done, kNow), Signals::Event::timeout);
    });
  }
}

} // namespace
} // namespace gnomon

#include "server/system/log.h"

#include <csignal>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>
#include <unistd.h>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

struct Pipe {
  Pipe() {
    int fds[2];
    EXPECT_EQ(::pipe2(fds, O_CLOEXEC), 0);
    reading = FileDescriptor(fds[0]);
    writing = FileDescriptor(fds[1]);
  }

  /// Everything until the writing side is closed.
  std::string readAll() {
    std::string all;
    char bytes[4096];
    for (ssize_t count = 0; (count = ::read(reading.get(), bytes, sizeof bytes)) > 0;) {
      all.append(bytes, static_cast<std::size_t>(count));
    }
    return all;
  }

  FileDescriptor reading, writing;
};

TEST(LineWriter, WritesEachLineInOrder) {
  Pipe pipe;
  {
    LineWriter writer(pipe.writing.get(), 1000);
    writer.put("one");
    writer.put("two");
    EXPECT_TRUE(writer.flush(Clock::now() + 10s));
  }
  pipe.writing.reset();
  EXPECT_EQ(pipe.readAll(), "one\ntwo\n");
}

TEST(LineWriter, NobodyWaitsForAReaderAndEveryLostLineIsCounted) {
  constexpr int kLines = 50'000;
  Pipe pipe;
  std::string all;
  std::thread reader;
  {
    LineWriter writer(pipe.writing.get(), 100'000);
    for (int i = 0; i < kLines; ++i) {
      writer.put("a line of a few dozen bytes, as those of requests are");
    }
    EXPECT_FALSE(writer.flush(Clock::now() + 20ms)) << "the pipe holds it all: the test shows nothing";
    reader = std::thread([&] { all = pipe.readAll(); });
    EXPECT_TRUE(writer.flush(Clock::now() + 10s));
  }
  pipe.writing.reset();
  reader.join();
  int kept = 0, dropped = 0;
  std::istringstream lines(all);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('{')) {
      dropped += std::stoi(nlohmann::json::parse(line)["detail"].get<std::string>());
    } else {
      ++kept;
    }
  }
  EXPECT_GT(dropped, 0);
  EXPECT_EQ(kept + dropped, kLines);
}

TEST(LineWriter, EndsThoughNobodyReads) {
  Pipe pipe;
  LineWriter writer(pipe.writing.get(), 1 << 20);
  writer.put(std::string(500'000, 'x'));
  EXPECT_FALSE(writer.flush(Clock::now() + 20ms));
}

TEST(LineWriter, AReaderThatIsGoneCostsItsLinesOnly) {
  Pipe pipe;
  std::signal(SIGPIPE, SIG_IGN);
  pipe.reading.reset();
  LineWriter writer(pipe.writing.get(), 1000);
  writer.put("lost");
  EXPECT_TRUE(writer.flush(Clock::now() + 10s));
}

} // namespace
} // namespace gnomon

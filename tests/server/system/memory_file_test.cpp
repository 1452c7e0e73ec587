#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <sys/mman.h>
#include <thread>
#include <unistd.h>

#include "server/system/file_descriptor.h"
#include "server/system/log.h"
#include "server/system/memory_limit.h"
#include "tests/server/system/pipe.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

TEST(MemoryFile, HoldsWhatWasWritten) {
  MemoryFileWriter writer;
  writer.add(Bytes{1, 2});
  writer.add(Bytes{});
  writer.add(Bytes{3});
  const auto file = writer.finish();
  ASSERT_TRUE(file);
  EXPECT_EQ(readFile(*file, 3), (Bytes{1, 2, 3}));
  EXPECT_FALSE(readFile(*file, 2)) << "more than asked for";
  EXPECT_FALSE(writer.finish()) << "there is only one";
}

TEST(MemoryFile, NobodyCanChangeIt) {
  const auto file = memoryFile(Bytes{1, 2, 3});
  ASSERT_TRUE(file);
  EXPECT_EQ(::ftruncate(file->get(), 1), -1);
  EXPECT_EQ(::pwrite(file->get(), "x", 1, 0), -1);
  EXPECT_EQ(::mmap(nullptr, 3, PROT_READ | PROT_WRITE, MAP_SHARED, file->get(), 0), MAP_FAILED);
  EXPECT_EQ(readFile(*file, 3), (Bytes{1, 2, 3}));
}

TEST(MemoryFile, TwoDescriptorsReadIndependently) {
  const auto file = memoryFile(Bytes{1, 2, 3});
  const FileDescriptor second(::dup(file->get()));
  EXPECT_EQ(readFile(*file, 3), readFile(second, 3));
  EXPECT_EQ(readFile(second, 3), (Bytes{1, 2, 3})) << "wherever the offset is";
}

TEST(MemoryFile, WhatIsNoFileCannotBeRead) {
  EXPECT_FALSE(readFile(FileDescriptor(), 10));
}

class MemoryGranted : public ::testing::Test {
 protected:
  MemoryGranted() {
    std::string pattern = (fs::temp_directory_path() / "gnomon-cgroup-XXXXXX").string();
    root_ = ::mkdtemp(pattern.data());
  }
  ~MemoryGranted() override { fs::remove_all(root_); }

  void write(const std::string& path, const std::string& text) {
    fs::create_directories((root_ / path).parent_path());
    std::ofstream(root_ / path) << text;
  }

  fs::path root_;
};

TEST_F(MemoryGranted, IsTheLeastOfAGroupAndThoseAboveIt) {
  write("a/b/memory.max", "max\n");
  write("a/memory.max", "3000\n");
  write("memory.max", "5000\n");
  EXPECT_EQ(memoryGranted(root_, "0::/a/b\n"), 3000u);
  EXPECT_EQ(memoryGranted(root_, "0::/\n"), 5000u) << "as a container sees its own group";
  write("a/b/memory.max", "2000\n");
  EXPECT_EQ(memoryGranted(root_, "0::/a/b\n"), 2000u);
}

TEST_F(MemoryGranted, UnderstandsTheFirstVersion) {
  write("memory/docker/memory.limit_in_bytes", "7000\n");
  EXPECT_EQ(memoryGranted(root_, "12:cpu,cpuacct:/docker\n9:memory:/docker\n"), 7000u);
}

TEST_F(MemoryGranted, NothingIsSet) {
  EXPECT_FALSE(memoryGranted(root_, "0::/a\n"));
  EXPECT_FALSE(memoryGranted(root_, ""));
  EXPECT_FALSE(memoryGranted(root_, "nonsense"));
  EXPECT_GT(memoryLimit(), 1u << 20);
}

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

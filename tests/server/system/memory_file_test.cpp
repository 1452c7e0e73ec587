#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sstream>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

#include "server/system/file_descriptor.h"
#include "server/system/log.h"
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

/// A memory file of so many zeros with these seals.
FileDescriptor fileSealed(int seals, std::size_t bytes) {
  FileDescriptor file(::memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  EXPECT_TRUE(writeAll(file, Bytes(bytes, 0)));
  EXPECT_EQ(::fcntl(file.get(), F_ADD_SEALS, seals), 0);
  return file;
}

constexpr int kAllSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE;
constexpr std::size_t kMuch = 1 << 20;

TEST(SealedBytes, AreThoseOfTheFileEvenOnceItIsClosed) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{3}, kMuch}) {
    const Bytes written(size, 'x');
    auto file = memoryFile(written);
    const auto bytes = sealedBytes(*file, size);
    file.reset();
    ASSERT_TRUE(bytes) << size;
    EXPECT_EQ(*bytes, asText(written));
    const SharedBytes copy = *bytes;
    EXPECT_EQ(copy.view().data(), bytes->view().data());
  }
  EXPECT_TRUE(sealedBytes(fileSealed(kAllSeals, kMuch), kMuch));
}

TEST(SealedBytes, AreNotThoseOfAFileThatMayChangeOrIsLarger) {
  for (const std::size_t size : {std::size_t{3}, kMuch}) {
    EXPECT_FALSE(sealedBytes(*memoryFile(Bytes(size, 'x')), size - 1));
    for (const int missing : {F_SEAL_SHRINK, F_SEAL_GROW, F_SEAL_WRITE})
      EXPECT_FALSE(sealedBytes(fileSealed(kAllSeals & ~missing, size), kMuch)) << missing;
  }
}

TEST(SealedBytes, AreNotThoseOfAnythingElse) {
  Pipe pipe;
  EXPECT_FALSE(sealedBytes(pipe.reading, kMuch));
  EXPECT_FALSE(sealedBytes(FileDescriptor(::eventfd(1, 0)), kMuch));
  EXPECT_FALSE(sealedBytes(FileDescriptor(::open("/proc/self/exe", O_RDONLY)), std::size_t{1} << 40));
  EXPECT_FALSE(sealedBytes(FileDescriptor(), kMuch));
  const FileDescriptor hollow(::memfd_create("test", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  ASSERT_EQ(::ftruncate(hollow.get(), kMuch), 0);
  ASSERT_EQ(::fcntl(hollow.get(), F_ADD_SEALS, kAllSeals), 0);
  EXPECT_FALSE(sealedBytes(hollow, kMuch)) << "its memory would have to be found while it is sent";
}

TEST(OpenRegular, OpensFilesAloneAndWaitsForNothing) {
  std::string folder = (fs::temp_directory_path() / "gnomon-open-XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const auto errorOf = [&](const std::string& name) {
    errno = 0;
    return openRegular(folder + "/" + name, O_RDONLY) ? 0 : errno;
  };
  std::ofstream(folder + "/file") << "text";
  fs::create_symlink(folder + "/file", folder + "/link");
  fs::create_directory(folder + "/folder");
  ASSERT_EQ(::mkfifo((folder + "/pipe").c_str(), 0600), 0);
  EXPECT_EQ(errorOf("file"), 0);
  for (const char* other : {"link", "folder", "pipe", "nothing"}) EXPECT_EQ(errorOf(other), ENOENT) << other;
  fs::remove_all(folder);
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

#include "server/system/memory_file.h"

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

namespace gnomon {
namespace {

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

} // namespace
} // namespace gnomon

#include "server/system/memory_limit.h"

#include <fstream>
#include <gtest/gtest.h>

namespace gnomon {
namespace {

namespace fs = std::filesystem;

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

} // namespace
} // namespace gnomon

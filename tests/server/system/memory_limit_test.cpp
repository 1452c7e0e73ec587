#include "server/system/memory_limit.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <string>

#include "renderer/core/control_groups.h"

namespace gnomon {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMiB = 1u << 20;

TEST(MemoryLimit, AllocationsEndBeforeTheProcessIsKilled) {
  const std::string status =
      "Name:\tgnomon\nVmData:\t  204800 kB\nRssAnon:\t  51200 kB\nRssFile:\t  20480 kB\nRssShmem:\t  1024 kB\n";
  const std::uint64_t most = 512 * kMiB;
  const std::uint64_t data = dataWithin(most, status);
  const std::uint64_t untouched = (204'800 - 51'200) * 1024;
  EXPECT_EQ(data, most - most / 16 - (20 + 1) * kMiB + untouched);
  EXPECT_LT(data - untouched + 21 * kMiB, most) << "with all that it may allocate, and its files";
}

TEST(MemoryLimit, LessThanItsFilesIsNothing) {
  EXPECT_EQ(dataWithin(kMiB, "Name:\tx\nVmData:\t0 kB\nRssAnon:\t0 kB\nRssFile:\t20480 kB\n"), 0u);
  EXPECT_EQ(dataWithin(kMiB, ""), kMiB - kMiB / 16);
}

/// Control groups as files of a test.
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

  /// A line of /proc/self/mountinfo: the group `top` of a hierarchy is mounted at `at`, below the test's folder.
  std::string mounted(const std::string& top, const std::string& at, const std::string& type) const {
    return "35 31 0:32 " + top + " " + (root_ / at).string() + " rw - " + type + " " + type + " rw,memory\n";
  }

  std::optional<std::uint64_t> granted(const std::string& membership, const std::string& mounts) const {
    return memoryGranted(controlGroups("memory", membership, mounts));
  }

  fs::path root_;
};

TEST_F(MemoryGranted, IsTheLeastOfAGroupAndThoseAboveIt) {
  const std::string mounts = mounted("/", "all", "cgroup2");
  write("all/a/b/memory.max", "max\n");
  write("all/a/memory.max", "3000\n");
  write("all/memory.max", "5000\n");
  EXPECT_EQ(granted("0::/a/b\n", mounts), 3000u);
  EXPECT_EQ(granted("0::/\n", mounts), 5000u) << "as a container sees its own group";
  write("all/a/b/memory.max", "2000\n");
  EXPECT_EQ(granted("0::/a/b\n", mounts), 2000u);
}

TEST_F(MemoryGranted, UnderstandsTheFirstVersion) {
  write("memory/docker/memory.limit_in_bytes", "7000\n");
  EXPECT_EQ(granted("12:cpu,cpuacct:/docker\n9:memory:/docker\n", mounted("/", "memory", "cgroup")), 7000u);
}

TEST_F(MemoryGranted, OfAGroupWithinAContainerIsFoundWhereItIsMounted) {
  for (const auto& [type, membership, name] :
       {std::array{"cgroup", "9:memory:/docker/1f2e/job\n", "memory.limit_in_bytes"},
        std::array{"cgroup2", "0::/docker/1f2e/job\n", "memory.max"}}) {
    const std::string at = std::string("in a ") + type;
    write(at + "/" + name, "9000\n");
    write(at + "/job/" + name, "4000\n");
    const std::string escaped = std::string("in\\040a\\040") + type;
    EXPECT_EQ(granted(membership, mounted("/docker/1f2e", escaped, type)), 4000u) << type;
  }
}

TEST_F(MemoryGranted, NothingIsSet) {
  EXPECT_FALSE(granted("0::/a\n", mounted("/", "all", "cgroup2")));
  EXPECT_FALSE(granted("", mounted("/", "all", "cgroup2")));
  EXPECT_FALSE(granted("0::/a\n", "nonsense"));
  EXPECT_GT(memoryLimit(), 1u << 20);
}

} // namespace
} // namespace gnomon

#include "server/system/memory_limit.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

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

} // namespace
} // namespace gnomon

#include "protocol/base/split_mix.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(SplitMix, GivesThePublishedNumbers) {
  constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
  EXPECT_EQ(splitMix64(0), 0xe220a8397b1dcdafu);
  EXPECT_EQ(splitMix64(kStep), 0x6e789e6aa1b965f4u);
  EXPECT_EQ(splitMix64(2 * kStep), 0x06c45d188009454fu);
}

TEST(SplitMix, MixesAllButZero) {
  EXPECT_EQ(mixed(0), 0u);
  EXPECT_EQ(mixed(0x9e3779b97f4a7c15u), splitMix64(0));
}

} // namespace
} // namespace gnomon

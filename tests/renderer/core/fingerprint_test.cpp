#include "renderer/core/fingerprint.h"

#include <gmock/gmock.h>

namespace gnomon {
namespace {

TEST(BuildIdentity, isTheLinkersHash) {
  EXPECT_THAT(buildId(), testing::MatchesRegex("[0-9a-f]{40}"));
}

TEST(BuildIdentity, ofALibraryIsItsOwn) {
  EXPECT_THAT(buildId("libc.so"), testing::MatchesRegex("[0-9a-f]{40}"));
  EXPECT_NE(buildId("libc.so"), buildId());
  EXPECT_EQ(buildId("libthatisnotloaded.so"), "");
}

TEST(BuildIdentity, namesTheCpu) {
  EXPECT_FALSE(cpuMake().empty());
}

TEST(Fingerprint, changesWithTheDriver) {
  RendererInfo info;
  info.renderer = "llvmpipe (LLVM 15.0.6, 256 bits)";
  info.version = "4.5";
  const std::string fingerprint = fingerprintOf(info);
  EXPECT_EQ(fingerprintOf(info), fingerprint);
  info.backend = "osmesa";
  EXPECT_EQ(fingerprintOf(info), fingerprint) << "the same driver draws the same, whoever opens it";
  info.version = "4.6";
  EXPECT_NE(fingerprintOf(info), fingerprint);
}

} // namespace
} // namespace gnomon

#include "renderer/gl/fingerprint.h"

#include <gmock/gmock.h>

#include "renderer/gl/context_setup.h"
#include "renderer/gl/texture.h"

namespace gnomon::gl {
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

TEST(SoftwareRenderer, isKnownByName) {
  EXPECT_TRUE(isSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(isSoftwareRenderer("softpipe"));
  EXPECT_FALSE(isSoftwareRenderer("NVIDIA H200/PCIe/SSE2"));
}

TEST(TexelLayout, countsBytes) {
  EXPECT_EQ(bytesPerTexel({GL_RGBA, GL_UNSIGNED_BYTE}), 4u);
  EXPECT_EQ(bytesPerTexel({GL_RGB, GL_HALF_FLOAT}), 6u);
  EXPECT_EQ(bytesPerTexel({GL_RG_INTEGER, GL_UNSIGNED_INT}), 8u);
  EXPECT_EQ(bytesPerTexel({GL_DEPTH_COMPONENT, GL_FLOAT}), 4u);
  EXPECT_EQ(bytesOf({5, 5, 3, 2}, {GL_RED, GL_FLOAT}), 24u);
}

} // namespace
} // namespace gnomon::gl

#include "renderer/gl/context_setup.h"

#include <gtest/gtest.h>

#include "renderer/gl/texture.h"

namespace gnomon::gl {
namespace {

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

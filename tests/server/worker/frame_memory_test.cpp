#include "server/worker/frame_memory.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

TEST(FrameMemory, CountsPixelsViewsAndFormat) {
  FrameSpec spec;
  spec.width = 100;
  spec.height = 50;
  EXPECT_EQ(frameBytes(spec), 100u * 50 * 4);
  spec.views = {View::color, View::depth};
  EXPECT_EQ(frameBytes(spec), 2u * 100 * 50 * 4);
  spec.output.format = ImageFormat::exr;
  EXPECT_EQ(frameBytes(spec), 2u * 100 * 50 * 16);
}

TEST(FrameMemory, TheAtlasHasItsOwnSize) {
  FrameSpec spec;
  spec.views = {View::atlas};
  spec.atlas.size = 2048;
  EXPECT_EQ(frameBytes(spec), 2048u * 2048 * 4);
  spec.views = {View::tile};
  EXPECT_EQ(frameBytes(spec), 2048u * 2048 * 4) << "no larger than the atlas";
}

TEST(FrameMemory, RaysTakeMemoryOncePerFrame) {
  FrameSpec spec;
  spec.width = 100;
  spec.height = 50;
  spec.views = {View::color, View::error, View::reference};
  EXPECT_EQ(frameBytes(spec), 3u * 100 * 50 * 4 + 100 * 50 * kReferenceBytes);
}

TEST(FrameMemory, TheLargestDoesNotOverflow) {
  FrameSpec spec;
  spec.width = spec.height = spec.atlas.size = 65536;
  spec.views = {View::color, View::depth, View::normal, View::cascades, View::shadow, View::atlas};
  spec.output.format = ImageFormat::exr;
  EXPECT_EQ(frameBytes(spec), 6ull * 65536 * 65536 * 16);
}

} // namespace
} // namespace gnomon

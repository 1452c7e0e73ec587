#include <gtest/gtest.h>

#include "renderer/video/video_file.h"
#include "tests/renderer/video/decoded_video.h"

namespace gnomon {
namespace {

struct Outcome {
  std::size_t bytes = 0;
  double worst = 100; ///< decibels
  int keys = 0;
};

Outcome encoded(const Vp9Settings& settings, int frames) {
  auto encoder = Vp9Encoder::create(settings);
  EXPECT_TRUE(encoder);
  VideoDecoder decoder;
  Outcome outcome;
  for (int i = 0; i < frames; ++i) {
    const Bytes planes = movingPattern(settings.width, settings.height, i);
    const auto frame = encoder->encode(planes);
    EXPECT_TRUE(frame);
    const auto picture = decoder.decode(frame->bytes);
    EXPECT_TRUE(picture) << "frame " << i;
    if (!picture) break;
    EXPECT_EQ(picture->width, settings.width);
    EXPECT_EQ(picture->height, settings.height);
    EXPECT_EQ(picture->space, VPX_CS_BT_709);
    EXPECT_EQ(picture->range, VPX_CR_STUDIO_RANGE);
    outcome.bytes += frame->bytes.size();
    outcome.worst = std::min(outcome.worst, psnr(planes, picture->planes));
    outcome.keys += frame->isKey ? 1 : 0;
  }
  return outcome;
}

TEST(Vp9Encoder, FramesComeOutAsTheyWentIn) {
  const Outcome outcome = encoded({.width = 160, .height = 96}, 10);
  EXPECT_GT(outcome.worst, 40);
  EXPECT_EQ(outcome.keys, 1);
  EXPECT_LT(outcome.bytes, std::size_t{10 * 160 * 96 / 8});
}

TEST(Vp9Encoder, AnySizeIsCodedAsItIs) {
  for (const auto& [width, height] : {std::pair(1, 1), {2, 1}, {1, 63}, {65, 37}, {129, 64}, {1021, 3}}) {
    SCOPED_TRACE(std::to_string(width) + "x" + std::to_string(height));
    EXPECT_GT(encoded({.width = width, .height = height}, 3).worst, 35);
  }
}

TEST(Vp9Encoder, MoreQualityIsNearerAndLarger) {
  Outcome before{.bytes = 0, .worst = 0};
  for (const int quality : {1, 30, 60, 90, 100}) {
    const Outcome outcome = encoded({.width = 160, .height = 96, .quality = quality}, 5);
    EXPECT_GT(outcome.worst, before.worst) << quality;
    EXPECT_GT(outcome.bytes, before.bytes) << quality;
    before = outcome;
  }
  EXPECT_GT(before.worst, 48);
}

TEST(Vp9Encoder, AKeyComesEveryTwoSeconds) {
  EXPECT_EQ(encoded({.width = 32, .height = 32, .framesPerSecond = 5}, 25).keys, 3);
  EXPECT_EQ(encoded({.width = 32, .height = 32, .framesPerSecond = 1}, 5).keys, 3);
}

TEST(Vp9Encoder, EqualPicturesGiveEqualBytes) {
  auto one = Vp9Encoder::create({.width = 640, .height = 256, .threads = 4});
  auto other = Vp9Encoder::create({.width = 640, .height = 256, .threads = 4});
  ASSERT_TRUE(one && other);
  for (int i = 0; i < 10; ++i) {
    const Bytes planes = movingPattern(640, 256, i);
    EXPECT_TRUE(one->encode(planes)->bytes == other->encode(planes)->bytes) << i;
  }
}

} // namespace
} // namespace gnomon

#include "renderer/video/video_file.h"

#include <gtest/gtest.h>

#include "tests/renderer/video/decoded_video.h"
#include "tests/renderer/video/parsed_webm.h"

namespace gnomon {
namespace {

constexpr VideoTrack kTrack{.width = 97, .height = 55, .framesPerSecond = 25, .frames = 12};

TEST(VideoFile, APlayerFindsEveryPicture) {
  auto video = VideoFile::create(kTrack, 80);
  ASSERT_TRUE(video);
  std::string file = video->head();
  for (int i = 0; i < kTrack.frames; ++i) {
    const Bytes planes = movingPattern(kTrack.width, kTrack.height, i);
    const auto piece = video->add({kTrack.width, kTrack.height, planes});
    ASSERT_TRUE(piece);
    file += *piece;
  }
  file += webmTag("A", "b");
  const ParsedWebm parsed = parsedWebm(file);
  ASSERT_TRUE(parsed.isWhole);
  EXPECT_DOUBLE_EQ(parsed.info.duration.value(), 480);
  ASSERT_EQ(parsed.frames.size(), 12u);
  EXPECT_TRUE(parsed.frames.front().isKey);
  VideoDecoder decoder;
  for (int i = 0; i < kTrack.frames; ++i) {
    const ParsedFrame& frame = parsed.frames[static_cast<std::size_t>(i)];
    EXPECT_EQ(frame.milliseconds, 40u * static_cast<unsigned>(i));
    const auto picture = decoder.decode(frame.bytes);
    ASSERT_TRUE(picture);
    EXPECT_GT(psnr(picture->planes, movingPattern(kTrack.width, kTrack.height, i)), 40);
  }
}

TEST(VideoFile, APictureOfAnotherSizeIsRefused) {
  auto video = VideoFile::create(kTrack, 80);
  ASSERT_TRUE(video);
  const Bytes planes = movingPattern(98, 55, 0);
  const auto other = video->add({98, 55, planes});
  ASSERT_FALSE(other);
  EXPECT_EQ(other.problems().front().code, ProblemCode::invalidValue);
  EXPECT_EQ(other.problems().front().limit, "97x55");
  EXPECT_EQ(other.problems().front().actual, "98x55");
  EXPECT_FALSE(video->add({97, 55, planes})) << "too many bytes";
}

TEST(VideoFile, WhatItTakesGrowsWithWholeBlocks) {
  EXPECT_GT(videoBytes(1, 1), std::size_t{32} << 20);
  EXPECT_LT(videoBytes(1920, 1080), std::size_t{230} << 20);
  EXPECT_LT(videoBytes(3840, 2160), std::size_t{1} << 30) << "one of this size fits into the default";
  EXPECT_GT(videoBytes(16384, 16), 16384u * 64 * 60);
}

} // namespace
} // namespace gnomon

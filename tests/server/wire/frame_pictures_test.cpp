#include "server/wire/frame_pictures.h"

#include <cstdint>
#include <gtest/gtest.h>

#include "protocol/spec/traits.h"

namespace gnomon {
namespace {

PictureNews png(std::string view, std::uint64_t bytes) {
  return {std::move(view), "image/png", bytes};
}

PictureNews raw(int width, int height, std::uint64_t bytes) {
  return {"color", std::string(kRawVideo), bytes, width, height};
}

TEST(FramePictures, EachPictureHasItsOwnBytes) {
  const auto pictures = FramePictures::of({png("color", 3), png("depth", 2)}, "colde");
  ASSERT_TRUE(pictures);
  std::vector<std::string> seen;
  EXPECT_TRUE(pictures->each([&](const PictureNews& picture, std::string_view bytes) {
    seen.push_back(picture.view + ":" + std::string(bytes));
    return true;
  }));
  EXPECT_EQ(seen, (std::vector<std::string>{"color:col", "depth:de"}));
  EXPECT_FALSE(pictures->each([](const PictureNews&, std::string_view) { return false; }));
  EXPECT_EQ(pictures->bytes(), "colde");
}

TEST(FramePictures, BytesAndPicturesFitExactlyOrNotAtAll) {
  EXPECT_TRUE(FramePictures::of({png("color", 5)}, "12345"));
  for (const std::uint64_t bytes : {0ul, 4ul, 6ul, ~0ul, kMostResultBytes + 1ul}) {
    const auto pictures = FramePictures::of({png("color", bytes)}, "12345");
    ASSERT_FALSE(pictures) << bytes;
    EXPECT_EQ(pictures.problems()[0].code, ProblemCode::internal);
  }
  EXPECT_FALSE(FramePictures::of({}, "12345"));
  EXPECT_FALSE(FramePictures::of({}, ""));
  EXPECT_FALSE(FramePictures::of({png("color", 5), png("depth", 0)}, "12345")) << "a picture without bytes";
}

TEST(FramePictures, NoSumWraps) {
  EXPECT_FALSE(bytesOf({png("color", ~0ull), png("depth", 6)})) << "their sum is 5";
  EXPECT_FALSE(FramePictures::of({png("color", ~0ull), png("depth", 6)}, "12345"));
  EXPECT_FALSE(bytesOf({png("color", 1'000'000), png("depth", ~0ull - 999'989)}));
  EXPECT_FALSE(bytesOf({png("color", kMostResultBytes), png("depth", 1)}));
  EXPECT_EQ(bytesOf({png("color", kMostResultBytes - 1), png("depth", 1)}), kMostResultBytes);
}

TEST(FramePictures, NamesAreThoseOfViewsAndFormats) {
  for (const FormatTraits& format : kFormatTraits)
    EXPECT_EQ(bytesOf({{"color", std::string(format.mediaType), 7}}), 7u);
  for (const char* view : {"", "nothing", "color\r\nX: y", "../color", "Color"}) EXPECT_FALSE(bytesOf({png(view, 7)}));
  for (const char* type : {"", "image/gif", "image/png\r\nX: y", "text/html"})
    EXPECT_FALSE(bytesOf({{"color", type, 7}}));
  EXPECT_FALSE(bytesOf({png("color", 3), png("color", 4)})) << "two files of one name";
  EXPECT_FALSE(bytesOf({{"color", "image/png", 7, 1, 1}})) << "the size is that of a raw picture";
}

TEST(FramePictures, ARawPictureIsAloneAndHasTheBytesOfItsSize) {
  EXPECT_EQ(bytesOf({raw(5, 3, 15 + 2 * 6)}), 27u);
  const auto pictures = FramePictures::of({raw(1, 1, 3)}, "yuv");
  ASSERT_TRUE(pictures && pictures->raw() != nullptr);
  EXPECT_FALSE(bytesOf({raw(5, 3, 26)}));
  EXPECT_FALSE(bytesOf({raw(5, 3, 28)}));
  EXPECT_FALSE(bytesOf({raw(1, 1, 3), png("depth", 1)}));
  for (const int side : {-1, 0, 65'536, INT32_MAX}) EXPECT_FALSE(bytesOf({raw(side, 1, 3)})) << side;
  EXPECT_EQ(FramePictures::of({png("color", 3)}, "123")->raw(), nullptr);
  EXPECT_EQ(FramePictures().raw(), nullptr);
}

TEST(SequenceNews, WhatCannotBeThePicturesOfAFrameIsNone) {
  const auto isRead = [](const std::vector<PictureNews>& pictures) {
    return readSequenceNews(textOf(SequenceNews{.pictures = pictures})).has_value();
  };
  EXPECT_TRUE(isRead({png("color", 5)}));
  EXPECT_FALSE(isRead({})) << "neither drawn nor encoded";
  EXPECT_FALSE(isRead({png("color", ~0ull), png("depth", 6)}));
  EXPECT_FALSE(isRead({png("color\r\nX: y", 5)}));
  EXPECT_TRUE(readSequenceNews(textOf(SequenceNews{.drawn = DrawnNews{}})));
}

} // namespace
} // namespace gnomon

// The same pixels a few rows at a time.
#include <algorithm>
#include <cstdint>

#include "renderer/image/jpeg_encode.h"
#include "renderer/image/png_encode.h"
#include "renderer/image/webp_encode.h"
#include "tests/renderer/image/rows_of.h"

namespace gnomon {
namespace {

Image pictureOf(int width, int height) {
  std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(i / 9 + i * 2654435761u % 41);
  return {width, height, {"R", "G", "B", "A"}, std::move(bytes)};
}

TEST(DecodedRows, AreThoseOfTheWholePicture) {
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(70, 15), std::pair(33, 16), std::pair(5, 17), std::pair(40, 203)}) {
    const Image picture = pictureOf(width, height);
    for (const Result<Bytes>& file : {encodePng(picture, 6), encodeJpeg(picture, 90), encodeWebp(picture, 90)}) {
      ASSERT_TRUE(file);
      const auto whole = decodeImage(*file, 512, 512 * 512);
      ASSERT_TRUE(whole);
      for (const int atOnce : {16, 48, 64, 256}) {
        EXPECT_EQ(rowsOf(*file, atOnce), std::get<Bytes>(whole->pixels)) << width << " x " << height << ", " << atOnce;
      }
    }
  }
}

TEST(DecodedRows, ArePassedOnBeforeTheLastOnesAreDecoded) {
  for (const Result<Bytes>& file : {encodePng(pictureOf(40, 200), 6), encodeJpeg(pictureOf(40, 200), 90)}) {
    ASSERT_TRUE(file);
    auto checked = checkImage(*file, 512, 512 * 512);
    ASSERT_TRUE(checked);
    int steps = 0;
    const std::string wrong = decodeRows(*checked, 32, [&](int first, std::span<const std::uint8_t> rgba) {
      EXPECT_EQ(first, 32 * steps++);
      EXPECT_EQ(rgba.size(), 4u * 40u * static_cast<std::size_t>(std::min(32, 200 - first)));
    });
    EXPECT_EQ(wrong, "");
    EXPECT_EQ(steps, 7);
  }
}

TEST(DecodedRows, OfABrokenFileAreAllThereAndItIsSaid) {
  const auto file = encodeJpeg(pictureOf(40, 200), 90);
  auto checked = checkImage(*file, 512, 512 * 512);
  ASSERT_TRUE(checked);
  checked->picture.bytes.resize(checked->picture.bytes.size() / 2);
  std::size_t bytes = 0;
  EXPECT_NE(decodeRows(*checked, 16, [&](int, std::span<const std::uint8_t> rgba) { bytes += rgba.size(); }), "");
  EXPECT_EQ(bytes, 4u * 40u * 200u);
}

} // namespace
} // namespace gnomon

// Of a picture whose file ends too early, the rows that it has are drawn, and the rest is what its format leaves.
#include <algorithm>
#include <array>
#include <cstdint>
#include <gtest/gtest.h>

#include "renderer/image/image_codec.h"
#include "renderer/image/picture_encode.h"
#include "tests/renderer/image/png_builder.h"
#include "tests/renderer/image/rows_of.h"

namespace gnomon {
namespace {

constexpr int kWidth = 24;
constexpr int kHeight = 40;
constexpr std::size_t kRow = 4 * kWidth;

Image noise() {
  std::vector<std::uint8_t> bytes(3 * kWidth * kHeight);
  std::uint32_t random = 7;
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>((random = random * 1664525u + 1013904223u) >> 24);
  return {kWidth, kHeight, {"R", "G", "B"}, std::move(bytes)};
}

/// By decodeRows(), whatever is wrong.
Bytes inRows(const CheckedImage& image, std::string& wrong) {
  Bytes pixels;
  wrong = decodeRows(image, 16, [&](int first, std::span<const std::uint8_t> rgba) {
    EXPECT_EQ(static_cast<std::size_t>(first) * kRow, pixels.size());
    pixels.insert(pixels.end(), rgba.begin(), rgba.end());
  });
  return pixels;
}

const Bytes& pixelsOf(const Image& image) {
  return std::get<Bytes>(image.pixels);
}

/// Of a file cut at each length: how many of the whole picture's first rows there are, at most. What is not read is
/// `rest`, where the format leaves rows as they are.
int mostRows(const Bytes& file, std::optional<std::array<std::uint8_t, 4>> rest) {
  const Bytes whole = pixelsOf(*decodeImage(file, 64, 4096));
  int most = 0;
  bool began = false;
  for (std::size_t size = 0; size < file.size(); ++size) {
    const auto checked = checkImage(std::span(file).first(size), 64, 4096);
    EXPECT_TRUE(checked || !began) << size;
    if (!checked) continue;
    began = true;
    const DecodedImage cut = decodeImage(*checked);
    EXPECT_TRUE(checked->picture.cutShort || !cut.wrong.empty()) << size;
    const Bytes& pixels = pixelsOf(cut.image);
    std::string wrong;
    EXPECT_TRUE(inRows(*checked, wrong) == pixels) << size;
    EXPECT_EQ(wrong, cut.wrong);
    EXPECT_TRUE(pixelsOf(decodeImage(*checked).image) == pixels) << "the same each time";
    int rows = 0;
    while (rows < kHeight && std::equal(whole.begin() + static_cast<std::ptrdiff_t>(kRow) * rows,
                                        whole.begin() + static_cast<std::ptrdiff_t>(kRow) * (rows + 1),
                                        pixels.begin() + static_cast<std::ptrdiff_t>(kRow) * rows)) {
      ++rows;
    }
    most = std::max(most, rows);
    for (std::size_t i = kRow * static_cast<std::size_t>(rows); rest && i < pixels.size(); ++i) {
      EXPECT_EQ(pixels[i], (*rest)[i % 4]) << size;
      if (pixels[i] != (*rest)[i % 4]) return most;
    }
  }
  EXPECT_TRUE(began);
  return most;
}

TEST(CutShort, APngHasTheRowsThatItHasAndTheRestIsTransparent) {
  EXPECT_EQ(mostRows(*encodePng(noise(), 6), std::array<std::uint8_t, 4>{0, 0, 0, 0}), kHeight);
}

TEST(CutShort, AJpegHasTheRowsThatItHas) {
  EXPECT_GE(mostRows(*encodeJpeg(noise(), 90), std::nullopt), kHeight - 8);
}

TEST(CutShort, AWebpHasTheRowsThatItHas) {
  EXPECT_GE(mostRows(*encodeWebp(noise(), 90), std::nullopt), 16);
  EXPECT_GE(mostRows(*encodeWebp(noise(), 100), std::nullopt), 16);
}

TEST(CutShort, APngWithoutItsEndIsWhole) {
  const Bytes file = *encodePng(noise(), 6);
  const auto checked = checkImage(std::span(file).first(file.size() - 12), 64, 4096);
  ASSERT_TRUE(checked);
  EXPECT_TRUE(checked->picture.cutShort);
  const DecodedImage image = decodeImage(*checked);
  EXPECT_EQ(image.wrong, "");
  EXPECT_TRUE(pixelsOf(image.image) == pixelsOf(*decodeImage(file, 64, 4096)));
}

TEST(CutShort, AJpegWithoutItsEndIsWhole) {
  const Bytes file = *encodeJpeg(noise(), 90);
  const auto checked = checkImage(std::span(file).first(file.size() - 2), 64, 4096);
  ASSERT_TRUE(checked);
  EXPECT_TRUE(checked->picture.cutShort);
  EXPECT_TRUE(pixelsOf(decodeImage(*checked).image) == pixelsOf(*decodeImage(file, 64, 4096)));
}

TEST(CutShort, WhatIsNoPictureAtAllIsRefused) {
  EXPECT_FALSE(checkImage(PngBuilder{.bitDepth = 3}.build(), 64, 4096)) << "a depth that PNG does not have";
  EXPECT_FALSE(checkImage(PngBuilder{.colorType = 3}.build(), 64, 4096)) << "no palette";
}

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

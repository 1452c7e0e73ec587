#include "renderer/image/image_codec.h"

#include <gtest/gtest.h>

#include "tests/renderer/image/png_builder.h"

namespace gnomon {
namespace {

using Pixels = std::vector<std::uint8_t>;

constexpr int kSide = 64;
constexpr std::int64_t kPixels = 4096;

/// The RGBA bytes of an encoded picture; empty where it was refused.
Pixels decoded(const Bytes& encoded) {
  auto image = decodeImage(encoded, kSide, kPixels);
  if (!image) {
    ADD_FAILURE() << image.problems().front().detail;
    return {};
  }
  EXPECT_EQ(image->channels, (std::vector<std::string>{"R", "G", "B", "A"}));
  return std::get<Pixels>(image->pixels);
}

ProblemCode refusal(const Bytes& encoded) {
  const auto image = decodeImage(encoded, kSide, kPixels);
  EXPECT_FALSE(image);
  return image ? ProblemCode::busy : image.problems().front().code;
}

TEST(DecodePng, ReadsEveryKindOfPixel) {
  EXPECT_EQ(decoded(PngBuilder{.width = 2, .rows = {{0, 200}}}.build()), (Pixels{0, 0, 0, 255, 200, 200, 200, 255}));
  EXPECT_EQ(decoded(PngBuilder{.width = 8, .height = 1, .bitDepth = 1, .rows = {{0x80}}}.build())[0], 255) << "1 bit";
  EXPECT_EQ(decoded(PngBuilder{.colorType = 2, .rows = {{1, 2, 3}}}.build()), (Pixels{1, 2, 3, 255}));
  EXPECT_EQ(decoded(PngBuilder{.colorType = 4, .rows = {{90, 7}}}.build()), (Pixels{90, 90, 90, 7}));
  EXPECT_EQ(decoded(PngBuilder{.colorType = 6, .rows = {{10, 20, 30, 40}}}.build()), (Pixels{10, 20, 30, 40}));
}

TEST(DecodePng, KeepsColourUnderTransparentPixels) {
  EXPECT_EQ(decoded(PngBuilder{.width = 2, .colorType = 6, .rows = {{250, 128, 3, 0, 250, 128, 3, 1}}}.build()),
            (Pixels{250, 128, 3, 0, 250, 128, 3, 1}));
}

TEST(DecodePng, ResolvesPalettes) {
  const Bytes palette{10, 20, 30, 40, 50, 60, 70, 80, 90};
  EXPECT_EQ(
      decoded(PngBuilder{.width = 2, .colorType = 3, .beforePixels = {{"PLTE", palette}}, .rows = {{2, 0}}}.build()),
      (Pixels{70, 80, 90, 255, 10, 20, 30, 255}));
  EXPECT_EQ(decoded(PngBuilder{
                .width = 2, .colorType = 3, .beforePixels = {{"PLTE", palette}, {"tRNS", {5}}}, .rows = {{0, 1}}}
                        .build()),
            (Pixels{10, 20, 30, 5, 40, 50, 60, 255}));
  EXPECT_EQ(
      decoded(PngBuilder{
          .width = 4, .bitDepth = 2, .colorType = 3, .beforePixels = {{"PLTE", palette}}, .rows = {{0b10'01'00'01}}}
                  .build()),
      (Pixels{70, 80, 90, 255, 40, 50, 60, 255, 10, 20, 30, 255, 40, 50, 60, 255}));
}

TEST(DecodePng, RoundsSixteenBitsToEight) {
  // 0x8080 is 128/255 of full scale exactly; 0x80ff is 128.49/255 and 0x8101 is 128.50/255.
  EXPECT_EQ(decoded(PngBuilder{.width = 3, .bitDepth = 16, .rows = {{0x80, 0x80, 0x80, 0xff, 0x81, 0x01}}}.build()),
            (Pixels{128, 128, 128, 255, 128, 128, 128, 255, 129, 129, 129, 255}));
  EXPECT_EQ(decoded(PngBuilder{.bitDepth = 16, .colorType = 6, .rows = {{0, 0, 255, 255, 128, 128, 0, 0}}}.build()),
            (Pixels{0, 255, 128, 0}));
}

TEST(DecodePng, ConvertsNoColour) {
  const Bytes gamma{0, 0, 0x4e, 0x20};
  EXPECT_EQ(decoded(PngBuilder{.colorType = 2, .beforePixels = {{"gAMA", gamma}}, .rows = {{1, 128, 254}}}.build()),
            (Pixels{1, 128, 254, 255}));
}

TEST(DecodePng, RefusesEveryTruncation) {
  const Bytes whole = PngBuilder{.width = 2, .height = 2, .colorType = 2, .rows = {Bytes(6, 1), Bytes(6, 2)}}.build();
  ASSERT_EQ(decoded(whole).size(), 16u);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_FALSE(decodeImage(std::span(whole).first(size), kSide, kPixels)) << size;
  }
}

TEST(DecodePng, RefusesRowsThatAreMissing) {
  EXPECT_EQ(refusal(PngBuilder{.width = 2, .height = 40, .rows = {{1, 2}}}.build()), ProblemCode::malformed);
}

TEST(DecodePng, RefusesChecksumsThatAreWrong) {
  Bytes damaged = PngBuilder{.colorType = 2, .rows = {{1, 2, 3}}}.build();
  damaged[29] ^= 1; // the header's checksum
  EXPECT_EQ(refusal(damaged), ProblemCode::malformed);
}

TEST(DecodePng, RefusesBombsByTheirHeaders) {
  EXPECT_EQ(refusal(PngBuilder{.width = 20000, .height = 20000, .bitDepth = 1}.build()), ProblemCode::tooLarge);
  EXPECT_EQ(refusal(PngBuilder{.width = 65, .height = 1}.build()), ProblemCode::tooLarge);
  const auto image = decodeImage(PngBuilder{.width = 64, .height = 64}.build(), 64, 4095);
  ASSERT_FALSE(image);
  EXPECT_EQ(image.problems().front().code, ProblemCode::tooLarge);
  EXPECT_EQ(image.problems().front().limit, "4095 pixels");
  EXPECT_EQ(image.problems().front().actual, "64x64");
}

} // namespace
} // namespace gnomon

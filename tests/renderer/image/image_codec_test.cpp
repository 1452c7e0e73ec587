#include "renderer/image/image_codec.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/image/image_container.h"
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

/// The start of a JPEG: application data, then a frame header of the given kind.
Bytes jpegStart(std::uint8_t frameMarker, std::uint8_t precision, int width, int height, std::uint8_t components) {
  const auto byte = [](int value) { return static_cast<std::uint8_t>(value & 0xff); };
  Bytes jpeg{0xff, 0xd8, 0xff, 0xe1, 0, 4, 0xff, 0xc0};
  const Bytes frame{0xff,        frameMarker, 0, 11,   precision, byte(height >> 8), byte(height), byte(width >> 8),
                    byte(width), components,  1, 0x11, 0};
  jpeg.insert(jpeg.end(), frame.begin(), frame.end());
  return jpeg;
}

ProblemCode codeOf(const Bytes& bytes) {
  const auto size = imageSize(bytes);
  EXPECT_FALSE(size);
  return size ? ProblemCode::busy : size.problems().front().code;
}

TEST(ImageSize, ReadsAPngsHeader) {
  const auto size = imageSize(PngBuilder{.width = 70000, .height = 3}.build());
  ASSERT_TRUE(size);
  EXPECT_EQ(size->width, 70000);
  EXPECT_EQ(size->height, 3);
}

TEST(ImageSize, ReadsAJpegsFrameHeaderBehindOtherSegments) {
  for (const std::uint8_t marker : Bytes{0xc0, 0xc1, 0xc2, 0xc9, 0xca}) {
    const auto size = imageSize(jpegStart(marker, 8, 640, 480, 3));
    ASSERT_TRUE(size);
    EXPECT_EQ(size->width, 640);
    EXPECT_EQ(size->height, 480);
  }
}

TEST(ImageSize, KnowsThreeSignaturesOnly) {
  EXPECT_EQ(codeOf({}), ProblemCode::unsupportedFeature);
  EXPECT_EQ(codeOf({'G', 'I', 'F', '8', '9', 'a', 1, 0, 1, 0}), ProblemCode::unsupportedFeature);
  EXPECT_EQ(codeOf({0x89, 'P', 'N', 'G'}), ProblemCode::unsupportedFeature);
  EXPECT_EQ(codeOf({'R', 'I', 'F', 'F', 4, 0, 0, 0, 'W', 'A', 'V', 'E'}), ProblemCode::unsupportedFeature);
}

TEST(ImageSize, RefusesSizesThatAreNone) {
  EXPECT_EQ(codeOf(PngBuilder{.width = 0}.build()), ProblemCode::malformed);
  EXPECT_EQ(codeOf(PngBuilder{.height = 0x80000000}.build()), ProblemCode::malformed);
  EXPECT_EQ(codeOf(jpegStart(0xc0, 8, 0, 480, 3)), ProblemCode::malformed);
  EXPECT_EQ(codeOf(jpegStart(0xc0, 8, 640, 0, 3)), ProblemCode::malformed);
}

TEST(ImageSize, RefusesJpegsThatAreNotRead) {
  EXPECT_EQ(codeOf(jpegStart(0xc3, 8, 640, 480, 3)), ProblemCode::unsupportedFeature) << "lossless";
  EXPECT_EQ(codeOf(jpegStart(0xc1, 12, 640, 480, 3)), ProblemCode::unsupportedFeature) << "12 bits";
  EXPECT_EQ(codeOf(jpegStart(0xc0, 8, 640, 480, 4)), ProblemCode::unsupportedFeature) << "CMYK";
}

TEST(ImageSize, RefusesEveryTruncationOfAHeader) {
  for (const Bytes& whole : {PngBuilder{}.build(), jpegStart(0xc0, 8, 640, 480, 3)}) {
    const std::size_t header = whole[0] == 0x89 ? 33 : whole.size();
    for (std::size_t size = 0; size < header; ++size) {
      EXPECT_FALSE(imageSize(EncodedBytes(whole).first(size))) << size;
    }
  }
}

TEST(ImageSize, ReadsNoByteOutsideOfHostileInput) {
  EXPECT_TRUE(rc::check("any bytes behind a signature give a size or a problem", [](const Bytes& tail, bool png) {
    Bytes bytes = png ? Bytes{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'} : Bytes{0xff, 0xd8, 0xff};
    bytes.insert(bytes.end(), tail.begin(), tail.end());
    const Bytes exact(bytes.begin(), bytes.end());
    const auto size = imageSize(exact);
    RC_ASSERT((!size || (size->width > 0 && size->height > 0)));
    const auto essential = png ? essentialPng(exact) : essentialJpeg(exact);
    RC_ASSERT((!essential || essential->bytes.size() <= exact.size()));
  }));
}

TEST(EssentialPng, DropsMetadataAndWhatFollowsTheEnd) {
  PngBuilder builder{.rows = {{7}}};
  const Bytes plain = builder.build();
  builder.beforePixels = {{"tEXt", {'a', 0, 'b'}}, {"iCCP", Bytes(300, 1)}, {"gAMA", {0, 0, 0, 1}}};
  Bytes decorated = builder.build();
  decorated.insert(decorated.end(), {1, 2, 3});
  const auto essential = essentialPng(decorated);
  ASSERT_TRUE(essential);
  EXPECT_EQ(essential->bytes, plain);
  EXPECT_FALSE(essential->cutShort);
}

TEST(EssentialPng, RefusesUnknownCriticalChunks) {
  const auto essential = essentialPng(PngBuilder{.beforePixels = {{"ABCD", {}}}, .rows = {{7}}}.build());
  ASSERT_FALSE(essential);
  EXPECT_EQ(essential.problems().front().code, ProblemCode::unsupportedFeature);
}

TEST(EssentialJpeg, DropsMetadataAndKeepsTheScan) {
  Bytes jpeg{0xff, 0xd8, 0xff, 0xe0, 0, 3, 9, 0xff, 0xfe, 0, 3, 9, 0xff, 0xe2, 0, 3, 9};
  const Bytes scan{0xff, 0xda, 0, 3, 9, 0x11, 0xff, 0x00, 0x22, 0xff, 0xd0, 0x33, 0xff, 0xd9};
  jpeg.insert(jpeg.end(), scan.begin(), scan.end());
  const auto essential = essentialJpeg(jpeg);
  ASSERT_TRUE(essential);
  Bytes expected{0xff, 0xd8, 0xff, 0xe0, 0, 3, 9};
  expected.insert(expected.end(), scan.begin(), scan.end());
  EXPECT_EQ(essential->bytes, expected);
  EXPECT_FALSE(essential->cutShort);
}

TEST(EssentialJpeg, RefusesAScanBomb) {
  Bytes jpeg{0xff, 0xd8};
  for (int i = 0; i < 1000; ++i) jpeg.insert(jpeg.end(), {0xff, 0xda, 0, 2});
  jpeg.insert(jpeg.end(), {0xff, 0xd9});
  const auto essential = essentialJpeg(jpeg);
  ASSERT_FALSE(essential);
  EXPECT_EQ(essential.problems().front().code, ProblemCode::tooLarge);
}

} // namespace
} // namespace gnomon

#include "renderer/image/image_container.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/renderer/image/png_builder.h"

namespace gnomon {
namespace {

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

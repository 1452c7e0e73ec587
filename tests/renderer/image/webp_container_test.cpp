#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "renderer/image/image_container.h"
#include "tests/support/webp_builder.h"

namespace gnomon {
namespace {

using testing::losslessBitstream;
using testing::losslessWebp;
using testing::webpCanvas;
using testing::webpChunk;
using testing::webpFile;

constexpr std::uint8_t kAlpha = 0x10;
constexpr std::uint8_t kAnimation = 0x02;

Bytes joined(const std::vector<Bytes>& parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The start of a lossy bitstream; the two upper bits of each side ask for scaling, which no decoder does.
Bytes lossyStart(int width, int height, std::uint8_t tag = 0x10) {
  const auto low = [](int side) { return static_cast<std::uint8_t>(side & 0xff); };
  const auto high = [](int side) { return static_cast<std::uint8_t>(side >> 8 | 0x40); };
  return {tag, 0, 0, 0x9d, 0x01, 0x2a, low(width), high(width), low(height), high(height), 0, 0};
}

Bytes lossyWebp(int width, int height) {
  return webpFile(webpChunk("VP8 ", lossyStart(width, height)));
}

Bytes extendedWebp(int width, int height) {
  return webpFile(joined(
      {webpChunk("VP8X", webpCanvas(kAlpha, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height))),
       webpChunk("ICCP", {1, 2, 3}), webpChunk("ALPH", {0}), webpChunk("VP8 ", lossyStart(width, height))}));
}

ProblemCode codeOf(const Bytes& bytes) {
  const auto size = imageSize(bytes);
  EXPECT_FALSE(size);
  return size ? ProblemCode::busy : size.problems().front().code;
}

TEST(WebpSize, ReadsTheHeadersOfAllThreeKinds) {
  for (const Bytes& file : {lossyWebp(640, 16383), losslessWebp(640, 16383, {}), extendedWebp(640, 16383)}) {
    const auto size = imageSize(file);
    ASSERT_TRUE(size) << size.problems().front().detail;
    EXPECT_EQ(size->width, 640);
    EXPECT_EQ(size->height, 16383);
  }
  const auto widest = imageSize(losslessWebp(16384, 1, {}));
  ASSERT_TRUE(widest);
  EXPECT_EQ(widest->width, 16384);
}

TEST(WebpSize, OfWhatIsCutShortIsThatOfItsHeaderAndTheRestIsMissed) {
  for (const Bytes& whole : {lossyWebp(64, 48), losslessWebp(2, 1, {1, 2, 3, 4, 5, 6, 7, 8}), extendedWebp(64, 48)}) {
    ASSERT_TRUE(imageSize(whole));
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const auto cut = essentialWebp(EncodedBytes(whole).first(size));
      EXPECT_TRUE(!cut || cut->cutShort || cut->bytes == essentialWebp(whole)->bytes) << size << " of " << whole.size();
    }
  }
}

TEST(WebpSize, RefusesLengthsThatLie) {
  for (const Bytes& whole : {lossyWebp(64, 48), losslessWebp(1, 1, {1, 2, 3, 4}), extendedWebp(64, 48)}) {
    for (const std::size_t field : {std::size_t{4}, std::size_t{16}}) {
      Bytes lying = whole;
      std::fill_n(lying.begin() + static_cast<std::ptrdiff_t>(field), 4, std::uint8_t{0});
      EXPECT_EQ(codeOf(lying), ProblemCode::malformed) << field;
    }
  }
}

TEST(WebpSize, RefusesACanvasThatIsNotThePicture) {
  for (const auto& [width, height] : {std::pair{65u, 48u}, std::pair{64u, 1u}, std::pair{1u << 24, 1u << 24}}) {
    const Bytes file =
        webpFile(joined({webpChunk("VP8X", webpCanvas(0, width, height)), webpChunk("VP8 ", lossyStart(64, 48))}));
    EXPECT_EQ(codeOf(file), ProblemCode::malformed);
  }
}

TEST(WebpSize, RefusesHeadersThatAreNone) {
  EXPECT_EQ(codeOf(lossyWebp(0, 48)), ProblemCode::malformed);
  EXPECT_EQ(codeOf(lossyWebp(64, 0)), ProblemCode::malformed);
  EXPECT_EQ(codeOf(webpFile(webpChunk("VP8 ", lossyStart(64, 48, 0x11)))), ProblemCode::malformed) << "no key frame";
  EXPECT_EQ(codeOf(webpFile(webpChunk("VP8 ", lossyStart(64, 48, 0x00)))), ProblemCode::malformed) << "not shown";
  Bytes longer = lossyStart(64, 48);
  longer[1] = 2; // the first partition has 16 bytes
  EXPECT_EQ(codeOf(webpFile(webpChunk("VP8 ", longer))), ProblemCode::malformed);
  Bytes unmarked = losslessBitstream(1, 1, {1, 2, 3, 4});
  unmarked[0] = 0x2e;
  EXPECT_EQ(codeOf(webpFile(webpChunk("VP8L", unmarked))), ProblemCode::malformed);
  Bytes newer = losslessBitstream(1, 1, {1, 2, 3, 4});
  newer[4] |= 0x20;
  EXPECT_EQ(codeOf(webpFile(webpChunk("VP8L", newer))), ProblemCode::malformed);
  EXPECT_EQ(codeOf(webpFile({})), ProblemCode::malformed);
  EXPECT_EQ(codeOf(webpFile(webpChunk("EXIF", {1, 2}))), ProblemCode::malformed);
  EXPECT_EQ(codeOf(webpFile(webpChunk("VP8X", Bytes(12, 0)))), ProblemCode::malformed);
}

TEST(WebpSize, RefusesAnimations) {
  const Bytes picture = webpChunk("VP8 ", lossyStart(64, 48));
  EXPECT_EQ(codeOf(webpFile(joined({webpChunk("VP8X", webpCanvas(kAnimation, 64, 48)), picture}))),
            ProblemCode::unsupportedFeature);
  EXPECT_EQ(codeOf(webpFile(joined({webpChunk("VP8X", webpCanvas(0, 64, 48)), webpChunk("ANIM", Bytes(6, 0)),
                                    webpChunk("ANMF", Bytes(16, 0)), picture}))),
            ProblemCode::unsupportedFeature);
}

TEST(WebpSize, ReadsNoByteOutsideOfHostileInput) {
  EXPECT_TRUE(rc::check("any bytes behind a signature give a size or a problem", [](const Bytes& tail, bool extended) {
    Bytes chunks = extended ? webpChunk("VP8X", webpCanvas(0, 1, 1)) : Bytes{};
    for (const char c : std::string_view(extended ? "VP8 " : "VP8L")) chunks.push_back(static_cast<std::uint8_t>(c));
    chunks.insert(chunks.end(), tail.begin(), tail.end());
    const Bytes exact = webpFile(chunks);
    const auto size = imageSize(exact);
    RC_ASSERT((!size || (size->width > 0 && size->height > 0)));
    RC_ASSERT(bool(essentialWebp(exact)) == bool(size));
  }));
}

TEST(EssentialWebp, DropsMetadataAndWhatFollowsTheEnd) {
  const Bytes bitstream = losslessBitstream(1, 1, {9, 8, 7, 255}, false);
  Bytes decorated = webpFile(joined({webpChunk("VP8X", webpCanvas(0x2c, 1, 1)), webpChunk("ICCP", Bytes(301, 1)),
                                     webpChunk("VP8L", bitstream), webpChunk("EXIF", {1}), webpChunk("XMP ", {2, 3})}));
  decorated.insert(decorated.end(), {1, 2, 3});
  const auto essential = essentialWebp(decorated);
  ASSERT_TRUE(essential);
  EXPECT_EQ(essential->bytes, webpFile(webpChunk("VP8L", bitstream)));
}

TEST(EssentialWebp, KeepsAlpha) {
  const Bytes lossless = losslessWebp(1, 1, {9, 8, 7, 6});
  EXPECT_EQ(essentialWebp(lossless)->bytes, lossless);
  EXPECT_EQ(essentialWebp(extendedWebp(64, 48))->bytes,
            webpFile(joined({webpChunk("VP8X", webpCanvas(kAlpha, 64, 48)), webpChunk("ALPH", {0}),
                             webpChunk("VP8 ", lossyStart(64, 48))})));
}

} // namespace
} // namespace gnomon

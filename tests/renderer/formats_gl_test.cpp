// One frame in every format: what each holds, against the numbers of an EXR and the bytes of a PNG.
#include <cmath>
#include <cstring>

#include "protocol/json/json_codec.h"
#include "protocol/spec/traits.h"
#include "tests/renderer/frame_fixture.h"

namespace gnomon {
namespace {

const std::vector<View> kViews{
    View::color,        View::depth,     View::normal,       View::cascades,  View::shadow, View::atlas,
    View::tile,         View::texelGrid, View::texelDensity, View::casterIds, View::error,  View::reference,
    View::edgeDistance, View::ids,       View::instances,    View::materials, View::albedo, View::position};

FrameSpec specOf(ImageFormat format, double alpha = 1) {
  const auto spec = decodeFrameSpec(
      R"({"width":61,"height":43,"camera":{"node":"camera"},"lights":[{"sun":{"azimuthDegrees":120,"elevationDegrees":40}}],
          "atlas":{"size":512,"baseSize":256},"output":{"exrPixelType":"float"}})");
  EXPECT_TRUE(spec) << spec.problems()[0].pointer << ' ' << spec.problems()[0].detail;
  FrameSpec made = spec ? *spec : FrameSpec{};
  made.views = kViews;
  made.background.alpha = alpha;
  made.output.format = format;
  return made;
}

Frame frameOf(const FrameSpec& spec) {
  auto frame = testing::sharedRenderer().render(testing::generatedScene("box_on_plane"), spec);
  EXPECT_TRUE(frame) << frame.problems()[0].pointer << ' ' << frame.problems()[0].detail;
  return frame ? *std::move(frame) : Frame{};
}

std::vector<EncodedPicture> filesOf(const Frame& frame) {
  auto files = encodePictures(frame, frame.images.size());
  EXPECT_TRUE(files) << files.problems()[0].detail;
  return files ? *std::move(files) : std::vector<EncodedPicture>{};
}

/// The numbers behind an array's header.
template <class Number>
std::vector<Number> arrayOf(const Bytes& npy) {
  const std::size_t header = 10u + npy[8] + 256u * npy[9];
  std::vector<Number> numbers((npy.size() - header) / sizeof(Number));
  std::memcpy(numbers.data(), npy.data() + header, npy.size() - header);
  return numbers;
}

template <class Number>
const std::vector<Number>& pixelsOf(const Frame& frame, std::size_t view) {
  return std::get<std::vector<Number>>(frame.images.at(view).image.pixels);
}

TEST(Formats, ArraysHoldTheNumbersOfAnExrAndTheBytesOfAPng) {
  const Frame exr = frameOf(specOf(ImageFormat::exr));
  const Frame png = frameOf(specOf(ImageFormat::png));
  const auto arrays = filesOf(frameOf(specOf(ImageFormat::npy)));
  ASSERT_EQ(arrays.size(), kViews.size());
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    SCOPED_TRACE(std::string(spell(kViews[i])));
    if (traitsOf(kViews[i]).srgb) {
      EXPECT_EQ(arrayOf<std::uint8_t>(arrays[i].file), pixelsOf<std::uint8_t>(png, i));
    } else if (holdsIndices(kViews[i])) {
      const auto ids = arrayOf<std::int32_t>(arrays[i].file);
      EXPECT_EQ(std::vector<float>(ids.begin(), ids.end()), pixelsOf<float>(exr, i));
      EXPECT_NE(std::count(ids.begin(), ids.end(), -1), static_cast<std::ptrdiff_t>(ids.size()));
    } else {
      EXPECT_EQ(arrayOf<float>(arrays[i].file), pixelsOf<float>(exr, i));
    }
  }
}

TEST(Formats, LinearArraysAreThoseOfAnExr) {
  FrameSpec spec = specOf(ImageFormat::npy, 0.5);
  spec.views = {View::color};
  spec.output.arrayColors = ArrayColors::linear;
  const auto array = arrayOf<float>(filesOf(frameOf(spec))[0].file);
  spec.output.format = ImageFormat::exr;
  const Frame exr = frameOf(spec);
  const auto& straight = pixelsOf<float>(exr, 0);
  ASSERT_EQ(exr.images[0].image.channels.size(), 4u);
  ASSERT_EQ(array.size(), straight.size());
  for (std::size_t i = 0; i < array.size(); ++i) {
    const float alpha = straight[i / 4 * 4 + 3];
    EXPECT_EQ(array[i], i % 4 == 3 ? alpha : straight[i] * alpha) << i;
  }
}

TEST(Formats, SixteenBitsHoldNumbersOrAreAFinerPicture) {
  const Frame exr = frameOf(specOf(ImageFormat::exr));
  const Frame png = frameOf(specOf(ImageFormat::png));
  FrameSpec spec = specOf(ImageFormat::png);
  spec.output.pngBits = 16;
  const Frame fine = frameOf(spec);
  for (std::size_t i = 0; i < kViews.size(); ++i) {
    SCOPED_TRACE(std::string(spell(kViews[i])));
    const auto& words = pixelsOf<std::uint16_t>(fine, i);
    if (wordsAreNumbers(kViews[i])) {
      const auto& numbers = pixelsOf<float>(exr, i);
      EXPECT_EQ(fine.images[i].image.channels, std::vector<std::string>{"Y"});
      ASSERT_EQ(words.size(), numbers.size());
      const double scale = kViews[i] == View::depth ? 1000 : 1;
      for (std::size_t p = 0; p < words.size(); ++p) {
        const bool none = !(numbers[p] >= 0 && numbers[p] * scale < 65534.5);
        ASSERT_NEAR(words[p], none ? 65535 : numbers[p] * scale, 0.51) << p;
      }
      continue;
    }
    const auto& bytes = pixelsOf<std::uint8_t>(png, i);
    EXPECT_EQ(fine.images[i].image.channels, png.images[i].image.channels);
    ASSERT_EQ(words.size(), bytes.size());
    // A driver's sRGB bytes may be the next, and what is painted over bytes is rounded twice. GPUs round others to
    // within 0.6 of a level.
    const bool twice = traitsOf(kViews[i]).srgb || traitsOf(kViews[i]).backdrop;
    const double rounding = twice ? 1.01 : testing::drawnByGpu() ? 0.61 : 0.51;
    for (std::size_t p = 0; p < words.size(); ++p) ASSERT_LE(std::abs(words[p] / 257.0 - bytes[p]), rounding) << p;
  }
  const auto isWidened = [](std::uint16_t word) { return word % 257 == 0; };
  const auto& color = pixelsOf<std::uint16_t>(fine, 0);
  EXPECT_LT(std::count_if(color.begin(), color.end(), isWidened), static_cast<std::ptrdiff_t>(color.size()) / 2);
}

TEST(Formats, SixteenBitNormalsAreTheNumbersOfAnExr) {
  FrameSpec spec = specOf(ImageFormat::exr);
  spec.views = {View::normal, View::depth};
  const Frame exr = frameOf(spec);
  spec.output.format = ImageFormat::png;
  spec.output.pngBits = 16;
  const Frame fine = frameOf(spec);
  const auto& normals = pixelsOf<float>(exr, 0);
  const auto& depths = pixelsOf<float>(exr, 1);
  const auto& words = pixelsOf<std::uint16_t>(fine, 0);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const double share = std::isinf(depths[i / 3]) ? 0 : normals[i] * 0.5 + 0.5;
    ASSERT_NEAR(words[i], share * 65535, 0.6) << i;
  }
}

TEST(Formats, EveryFormatTakesEveryView) {
  for (const FormatTraits& traits : kFormatTraits) {
    for (const double alpha : {1.0, 0.25}) {
      const auto files = filesOf(frameOf(specOf(traits.format, alpha)));
      EXPECT_EQ(files.size(), traits.allViews ? 1 : kViews.size()) << traits.suffix;
      for (const EncodedPicture& file : files) EXPECT_GT(file.file.size(), 60u) << traits.suffix << ' ' << file.view;
    }
  }
}

TEST(Formats, OneOfSeveralViewsIsTheFirst) {
  FrameSpec spec = specOf(ImageFormat::webp);
  spec.views = {View::normal, View::color};
  const auto first = encodePictures(frameOf(spec), 1);
  ASSERT_TRUE(first);
  ASSERT_EQ(first->size(), 1u);
  EXPECT_EQ(first->front().view, "normal");
}

} // namespace
} // namespace gnomon

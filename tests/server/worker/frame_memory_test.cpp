#include "server/worker/frame_memory.h"

#include <gtest/gtest.h>

#include "server/worker/orders.h"

namespace gnomon {
namespace {

TEST(FrameMemory, CountsPixelsViewsAndFormat) {
  FrameSpec spec;
  spec.width = 100;
  spec.height = 50;
  EXPECT_EQ(frameBytes(spec), 100u * 50 * 4);
  spec.views = {View::color, View::depth};
  EXPECT_EQ(frameBytes(spec), 2u * 100 * 50 * 4);
  spec.output.format = ImageFormat::exr;
  EXPECT_EQ(frameBytes(spec), 2u * 100 * 50 * 16);
}

TEST(FrameMemory, CountsWhatEncodingHolds) {
  FrameSpec spec;
  spec.width = 100;
  spec.height = 50;
  spec.views = {View::color, View::depth};
  const auto pixelBytes = [&](ImageFormat format) {
    spec.output.format = format;
    return frameBytes(spec) / (100 * 50);
  };
  EXPECT_EQ(pixelBytes(ImageFormat::tiff), 2u * (16 + 16) + 16);
  EXPECT_EQ(pixelBytes(ImageFormat::npy), (4 + 4) + (16 + 16) + 16u) << "colors are bytes";
  EXPECT_EQ(pixelBytes(ImageFormat::npz), (4 + 4) + (16 + 16) + 32u);
  EXPECT_EQ(pixelBytes(ImageFormat::jpeg), 2u * (4 + 4));
  EXPECT_EQ(pixelBytes(ImageFormat::webp), 2u * (4 + 4) + 16);
  spec.output.arrayColors = ArrayColors::linear;
  EXPECT_EQ(pixelBytes(ImageFormat::npy), 2u * (16 + 16) + 16);
  spec.output.pngBits = 16;
  EXPECT_EQ(pixelBytes(ImageFormat::png), 2u * 8);
}

TEST(FrameMemory, TheAtlasHasItsOwnSize) {
  FrameSpec spec;
  spec.views = {View::atlas};
  spec.atlas.size = 2048;
  EXPECT_EQ(frameBytes(spec), 2048u * 2048 * 4);
  spec.views = {View::tile};
  EXPECT_EQ(frameBytes(spec), 2048u * 2048 * 4) << "no larger than the atlas";
}

TEST(FrameMemory, RaysTakeMemoryOncePerFrame) {
  FrameSpec spec;
  spec.width = 100;
  spec.height = 50;
  spec.views = {View::color, View::error, View::reference};
  EXPECT_EQ(frameBytes(spec), 3u * 100 * 50 * 4 + 100 * 50 * kReferenceBytes);
}

TEST(FrameMemory, TheLargestDoesNotOverflow) {
  FrameSpec spec;
  spec.width = spec.height = spec.atlas.size = 65536;
  spec.views = {View::color, View::depth, View::normal, View::cascades, View::shadow, View::atlas};
  spec.output.format = ImageFormat::exr;
  EXPECT_EQ(frameBytes(spec), 6ull * 65536 * 65536 * 16);
}

TEST(QualityChoices, RemembersTheLastThatWasUsed) {
  QualityChoices choices;
  QualityChoice choice;
  choice.report.chosen = 3;
  EXPECT_FALSE(choices.find("a"));
  choices.keep("a", choice);
  choices.keep("b", {});
  ASSERT_TRUE(choices.find("a"));
  EXPECT_EQ(choices.find("a")->report.chosen, 3u);
  for (int i = 0; i < 1023; ++i) choices.keep(std::to_string(i), {});
  EXPECT_TRUE(choices.find("a")) << "used after b";
  EXPECT_FALSE(choices.find("b"));
}

QualityChoice measuredIn(std::string view) {
  QualityChoice choice{std::move(view), {}};
  choice.report.met = true;
  choice.report.tried.resize(1);
  return choice;
}

TEST(QualityChoices, AnotherViewIsGivenTheSettingsAndNotThatTheTargetIsMet) {
  const QualityReport same = reusedReport(measuredIn("here"), "here");
  EXPECT_EQ(same.met, true);
  EXPECT_TRUE(same.cached);
  const QualityReport other = reusedReport(measuredIn("here"), "there");
  EXPECT_FALSE(other.met.has_value());
  EXPECT_TRUE(other.cached);
  EXPECT_EQ(other.tried.size(), 1u);
}

TEST(QualityChoices, AreReadAsTheyWereStored) {
  const auto read = readQualityChoice(textOf(measuredIn("here")));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->view, "here");
  EXPECT_EQ(read->report.met, true);
  for (const char* text : {"", "{}", "here", "here\n", "here\n{}"}) EXPECT_FALSE(readQualityChoice(text)) << text;
}

} // namespace
} // namespace gnomon

#include "protocol/sequence/video_frames.h"

#include <gtest/gtest.h>

#include "protocol/spec/format_traits.h"

namespace gnomon {
namespace {

TEST(VideoFrames, AFrameHasOneViewAsItIsSeen) {
  FrameSpec spec;
  spec.views = {View::depth, View::color};
  spec.output.format = ImageFormat::exr;
  spec.output.pngBits = 16;
  const FrameSpec frame = videoFrame(spec);
  EXPECT_EQ(frame.views, std::vector<View>{View::depth});
  EXPECT_EQ(pixelTypeOf(View::depth, frame.output), PixelType::bytes);
}

std::optional<Problem> sizeProblem(const Json& request) {
  FrameSizes sizes;
  const auto sequence = decodeSequence(request.dump(), [&](const FrameSpec& spec) { sizes.see(spec); });
  EXPECT_TRUE(sequence);
  return sizes.problem(*sequence);
}

TEST(VideoFrames, TheFirstFrameOfAnotherSizeIsNamed) {
  Json request = {{"spec", {{"width", 64}, {"height", 48}}}, {"stable", false}};
  request["frames"] = {Json::object(), {{"exposure", 1}}, {{"width", 64}}};
  EXPECT_FALSE(sizeProblem(request));
  request["frames"].push_back({{"height", 49}});
  request["frames"].push_back({{"width", 65}});
  const auto problem = sizeProblem(request);
  ASSERT_TRUE(problem);
  EXPECT_EQ(problem->pointer, "/frames/3/height");
  EXPECT_EQ(problem->limit, "64x48");
  EXPECT_EQ(problem->actual, "64x49");
  request["first"] = 3;
  EXPECT_EQ(sizeProblem(request)->pointer, "/frames/4/width") << "what comes before the first does not count";
  request["first"] = 4;
  EXPECT_FALSE(sizeProblem(request));
}

} // namespace
} // namespace gnomon

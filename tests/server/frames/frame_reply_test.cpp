#include "server/frames/frame_reply.h"

#include <gtest/gtest.h>
#include <set>

namespace gnomon {
namespace {

TEST(Etag, IsStrongForPicturesAndWeakForReports) {
  EXPECT_EQ(frameEtag("id", {}, "f", {}).front(), '"');
  EXPECT_TRUE(frameEtag("id", {}, "f", {ReplyForm::json, ImageFormat::png}).starts_with("W/\""));
}

TEST(Etag, TellsEverythingApart) {
  FrameSpec wider;
  wider.width = 1281;
  FrameSpec byCpu;
  byCpu.device = DeviceChoice::cpu;
  FrameSpec byGl;
  byGl.device = DeviceChoice::gl;
  const std::set<std::string> tags{frameEtag("id", {}, "f", {}),
                                   frameEtag("di", {}, "f", {}),
                                   frameEtag("id", {}, "g", {}),
                                   frameEtag("id", wider, "f", {}),
                                   frameEtag("id", byCpu, "f", {}),
                                   frameEtag("id", byGl, "f", {}),
                                   frameEtag("id", {}, "f", {ReplyForm::image, ImageFormat::exr}),
                                   frameEtag("id", {}, "f", {ReplyForm::multipart, ImageFormat::png}),
                                   frameEtag("id", {}, "f", {ReplyForm::multipart, ImageFormat::exr}),
                                   frameEtag("id", {}, "f", {ReplyForm::json, ImageFormat::png})};
  EXPECT_EQ(tags.size(), 10u);
}

TEST(Etag, IsTheSameForTheSame) {
  EXPECT_EQ(frameEtag("id", {}, "f", {}), frameEtag("id", FrameSpec{}, "f", {}));
}

TEST(FrameCost, CountsPixelsViewsAndFormat) {
  FrameSpec spec;
  spec.width = 100;
  spec.height = 50;
  EXPECT_EQ(frameBytes(spec), 100u * 50 * 4);
  spec.views = {View::color, View::depth};
  EXPECT_EQ(frameBytes(spec), 2u * 100 * 50 * 4);
  spec.output.format = ImageFormat::exr;
  EXPECT_EQ(frameBytes(spec), 2u * 100 * 50 * 16);
}

TEST(FrameCost, TheAtlasHasItsOwnSize) {
  FrameSpec spec;
  spec.views = {View::atlas};
  spec.atlas.size = 2048;
  EXPECT_EQ(frameBytes(spec), 2048u * 2048 * 4);
  spec.views = {View::tile};
  EXPECT_EQ(frameBytes(spec), 2048u * 2048 * 4) << "no larger than the atlas";
}

TEST(FrameCost, RaysTakeMemoryOncePerFrame) {
  FrameSpec spec;
  spec.width = 100;
  spec.height = 50;
  spec.views = {View::color, View::error, View::reference};
  EXPECT_EQ(frameBytes(spec), 3u * 100 * 50 * 4 + 100 * 50 * kReferenceBytes);
}

TEST(FrameCost, TheLargestDoesNotOverflow) {
  FrameSpec spec;
  spec.width = spec.height = spec.atlas.size = 65536;
  spec.views = {View::color, View::depth, View::normal, View::cascades, View::shadow, View::atlas};
  spec.output.format = ImageFormat::exr;
  EXPECT_EQ(frameBytes(spec), 6ull * 65536 * 65536 * 16);
}

TEST(FrameReply, TellsTheStages) {
  EXPECT_EQ(serverTiming({{"queue", 0.1234}, {"load", 12}}), "queue;dur=0.123, load;dur=12.000");
  EXPECT_EQ(serverTiming({}), "");
}

} // namespace
} // namespace gnomon

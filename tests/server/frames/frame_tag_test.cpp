#include "server/frames/frame_tag.h"

#include <gtest/gtest.h>
#include <set>

namespace gnomon {
namespace {

TEST(Etag, IsStrongForPicturesAndWeakForReports) {
  EXPECT_EQ(frameEtag("id", {}, "f", {}).front(), '"');
  EXPECT_TRUE(frameEtag("id", {}, "f", {ReplyForm::json, ImageFormat::png}).starts_with("W/\""));
}

TEST(Etag, IsWeakForAZipWhichHoldsTheReport) {
  for (const FormatTraits& traits : kFormatTraits) {
    const bool weak = frameEtag("id", {}, "f", {ReplyForm::image, traits.format}).starts_with("W/");
    EXPECT_EQ(weak, traits.format == ImageFormat::npz) << traits.suffix;
  }
}

TEST(ReprDigest, IsThatOfTheBody) {
  EXPECT_EQ(reprDigest("abc"), "sha-256=:ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0=:") << "FIPS 180-4's example";
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

} // namespace
} // namespace gnomon

#include "server/frames/etag.h"

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
  const std::set<std::string> tags{frameEtag("id", {}, "f", {}),
                                   frameEtag("di", {}, "f", {}),
                                   frameEtag("id", {}, "g", {}),
                                   frameEtag("id", wider, "f", {}),
                                   frameEtag("id", {}, "f", {ReplyForm::image, ImageFormat::exr}),
                                   frameEtag("id", {}, "f", {ReplyForm::multipart, ImageFormat::png}),
                                   frameEtag("id", {}, "f", {ReplyForm::multipart, ImageFormat::exr}),
                                   frameEtag("id", {}, "f", {ReplyForm::json, ImageFormat::png})};
  EXPECT_EQ(tags.size(), 8u);
}

TEST(Etag, IsTheSameForTheSame) {
  EXPECT_EQ(frameEtag("id", {}, "f", {}), frameEtag("id", FrameSpec{}, "f", {}));
}

TEST(Etag, MatchesListsWeaklyAndStars) {
  EXPECT_TRUE(etagMatches("\"a\"", "\"a\""));
  EXPECT_TRUE(etagMatches("\"x\", W/\"a\" ,\"y\"", "\"a\""));
  EXPECT_TRUE(etagMatches("\"a\"", "W/\"a\""));
  EXPECT_TRUE(etagMatches(" * ", "\"a\""));
  EXPECT_FALSE(etagMatches("", "\"a\""));
  EXPECT_FALSE(etagMatches("a", "\"a\""));
  EXPECT_FALSE(etagMatches("\"b\", \"c\"", "\"a\""));
}

} // namespace
} // namespace gnomon

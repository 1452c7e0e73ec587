#include "server/frames/reply_cache.h"

#include <gtest/gtest.h>
#include <set>

namespace gnomon {
namespace {

HttpReply picture(std::size_t bytes) {
  HttpReply reply;
  reply.contentType = "image/png";
  reply.body = std::string(bytes, 'x');
  reply.stages = {{"shade", 1}};
  return reply;
}

TEST(ReplyCache, GivesBackWhatItKept) {
  ReplyCache cache(1000);
  EXPECT_FALSE(cache.find("a"));
  cache.keep("a", picture(100));
  const auto found = cache.find("a");
  ASSERT_TRUE(found);
  EXPECT_EQ(found->body.size(), 100u);
  EXPECT_EQ(found->contentType, "image/png");
  EXPECT_TRUE(found->stages.empty()) << "nothing was done for it";
  EXPECT_EQ(found->headers.front().first, "Cache-Status");
  EXPECT_EQ(found->headers.size(), 1u);
}

TEST(ReplyCache, KeepsTheDigest) {
  ReplyCache cache(1000);
  HttpReply reply = picture(100);
  reply.headers = {{"Server-Timing", "shade;dur=1"}, {"Repr-Digest", "sha-256=:x:"}};
  cache.keep("a", reply);
  const std::pair<std::string, std::string> digest{"Repr-Digest", "sha-256=:x:"};
  ASSERT_TRUE(cache.find("a"));
  EXPECT_EQ(cache.find("a")->headers.back(), digest);
  EXPECT_EQ(cache.find("a")->headers.size(), 2u);
}

TEST(ReplyCache, DropsTheLeastRecentlyUsed) {
  ReplyCache cache(1000);
  for (const char* etag : {"a", "b", "c", "d", "e", "f", "g", "h", "i", "j"}) cache.keep(etag, picture(100));
  EXPECT_TRUE(cache.find("a"));
  cache.keep("k", picture(100));
  EXPECT_TRUE(cache.find("a"));
  EXPECT_FALSE(cache.find("b"));
}

TEST(ReplyCache, TellsOfHowMuchUseItIs) {
  ReplyCache cache(1000);
  cache.find("a");
  cache.findAgain("a");
  cache.keep("a", picture(100));
  cache.find("a");
  cache.find("a");
  EXPECT_EQ(cache.use().bytes, 100u);
  EXPECT_EQ(cache.use().hits, 2u);
  EXPECT_EQ(cache.use().misses, 1u) << "who looks again has been counted";
}

TEST(ReplyCache, KnowsTheLastRequestsOfWhatItKeeps) {
  ReplyCache cache(1000);
  cache.remember("early", "a");
  cache.keep("a", picture(100));
  EXPECT_FALSE(cache.findRequest("early")) << "nothing was kept under the tag";
  for (const char* request : {"1", "2", "3", "4", "5", "2"}) cache.remember(request, "a");
  EXPECT_FALSE(cache.findRequest("1"));
  ASSERT_TRUE(cache.findRequest("2"));
  EXPECT_EQ(cache.findRequest("5")->etag, "a");
  EXPECT_EQ(cache.findRequest("5")->reply->body.size(), 100u);
  EXPECT_EQ(cache.use().hits, 3u);
  EXPECT_EQ(cache.use().misses, 0u);
  cache.remember(std::string(1025, 'x'), "a");
  EXPECT_FALSE(cache.findRequest(std::string(1025, 'x')));
}

TEST(ReplyCache, ForgetsRequestsWithTheirReply) {
  ReplyCache cache(1000);
  cache.keep("a", picture(100));
  cache.remember("request", "a");
  for (const char* etag : {"b", "c", "d", "e", "f", "g", "h", "i", "j", "k"}) cache.keep(etag, picture(100));
  EXPECT_FALSE(cache.findRequest("request"));
  cache.keep("a", picture(50));
  EXPECT_FALSE(cache.findRequest("request"));
}

TEST(ReplyCache, KeepsNoProblemsAndNothingLarge) {
  ReplyCache cache(1000);
  cache.keep("large", picture(126));
  HttpReply problem = picture(10);
  problem.status = 504;
  cache.keep("problem", problem);
  EXPECT_FALSE(cache.find("large"));
  EXPECT_FALSE(cache.find("problem"));
  ReplyCache none(0);
  none.keep("a", picture(1));
  EXPECT_FALSE(none.find("a"));
}

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

} // namespace
} // namespace gnomon

#include "server/http/negotiation.h"

#include <gtest/gtest.h>
#include <string>

namespace gnomon {
namespace {

/// "image/png", or "multipart/mixed of exr"; "none".
std::string chosen(std::optional<std::string_view> accept, ImageFormat format = ImageFormat::png) {
  const auto form = negotiate(accept, format);
  if (!form) {
    return "none";
  }
  const std::string type(mediaTypeOf(*form));
  return form->form == ReplyForm::image ? type : type + (form->format == ImageFormat::png ? " of png" : " of exr");
}

TEST(Negotiation, FollowsTheSpecWhereAcceptLeavesItOpen) {
  for (const std::optional<std::string_view> accept :
       {std::optional<std::string_view>(), std::optional<std::string_view>(""), std::optional<std::string_view>("*/*"),
        std::optional<std::string_view>("image/*"), std::optional<std::string_view>("image/png, image/x-exr"),
        std::optional<std::string_view>("text/html, image/avif;q=0.9, */*;q=0.8")}) {
    EXPECT_EQ(chosen(accept, ImageFormat::png), "image/png") << accept.value_or("absent");
    EXPECT_EQ(chosen(accept, ImageFormat::exr), "image/x-exr") << accept.value_or("absent");
  }
}

TEST(Negotiation, AnImageTypeDecidesTheFormat) {
  EXPECT_EQ(chosen("image/x-exr", ImageFormat::png), "image/x-exr");
  EXPECT_EQ(chosen("image/png", ImageFormat::exr), "image/png");
  EXPECT_EQ(chosen("IMAGE/PNG", ImageFormat::exr), "image/png");
}

TEST(Negotiation, FormsWithAReportKeepTheSpecsFormat) {
  EXPECT_EQ(chosen("multipart/mixed", ImageFormat::exr), "multipart/mixed of exr");
  EXPECT_EQ(chosen("application/json", ImageFormat::exr), "application/json of exr");
  EXPECT_EQ(chosen("application/json"), "application/json of png");
}

TEST(Negotiation, WeighsQualities) {
  EXPECT_EQ(chosen("image/png;q=0.5, application/json"), "application/json of png");
  EXPECT_EQ(chosen("image/png;q=0.5, application/json;q=0.4"), "image/png");
  EXPECT_EQ(chosen("image/x-exr, */*;q=0.1"), "image/x-exr");
  EXPECT_EQ(chosen("*/*, image/png;q=0"), "image/x-exr");
  EXPECT_EQ(chosen("image/*;q=0, */*"), "multipart/mixed of png");
}

TEST(Negotiation, TheTypeItselfBeatsAGroupOfTheSameQuality) {
  EXPECT_EQ(chosen("application/json, */*"), "application/json of png");
}

TEST(Negotiation, GivesUpWhereNothingFits) {
  for (const char* accept :
       {"text/html", "image/png;q=0", "image/jpeg, image/webp", "*/*;q=0", "image/png;q=x", ",;,"}) {
    EXPECT_EQ(chosen(accept), "none") << accept;
  }
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

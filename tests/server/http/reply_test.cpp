#include "server/http/reply.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "server/http/negotiation.h"

namespace gnomon {
namespace {

TEST(ProblemReply, EveryKindHasItsStatus) {
  const std::map<ProblemCode, int> expected{{ProblemCode::malformed, 400},
                                            {ProblemCode::invalidValue, 400},
                                            {ProblemCode::notFound, 404},
                                            {ProblemCode::methodNotAllowed, 405},
                                            {ProblemCode::unauthorized, 401},
                                            {ProblemCode::forbidden, 403},
                                            {ProblemCode::misdirected, 421},
                                            {ProblemCode::insufficientStorage, 507},
                                            {ProblemCode::notAcceptable, 406},
                                            {ProblemCode::lengthRequired, 411},
                                            {ProblemCode::tooLarge, 413},
                                            {ProblemCode::unsupportedMediaType, 415},
                                            {ProblemCode::invalidScene, 422},
                                            {ProblemCode::unsupportedFeature, 422},
                                            {ProblemCode::hashMismatch, 422},
                                            {ProblemCode::busy, 429},
                                            {ProblemCode::deadlineExceeded, 504},
                                            {ProblemCode::unavailable, 503},
                                            {ProblemCode::preconditionFailed, 412},
                                            {ProblemCode::backend, 500},
                                            {ProblemCode::internal, 500}};
  for (const auto& [code, status] : expected) {
    EXPECT_EQ(statusOf(code), status);
  }
  EXPECT_EQ(expected.size(), static_cast<std::size_t>(ProblemCode::internal) + 1);
}

TEST(ProblemReply, AListWithoutAProblemIsAMistakeOfTheServersOwn) {
  const HttpReply reply = problemReply({}, "request-1");
  EXPECT_EQ(reply.status, 500);
  EXPECT_EQ(nlohmann::json::parse(reply.body.view())["problems"].size(), 1u);
  EXPECT_FALSE(reply.problem.empty());
}

TEST(ProblemReply, HoldsEveryProblemAndIsNeverCached) {
  const HttpReply reply = problemReply({{ProblemCode::invalidValue, "/width", "Too wide.", "1..8192", "9000"},
                                        {ProblemCode::invalidValue, "/height", "Too high.", "", "\xff"}},
                                       "request-1");
  EXPECT_EQ(reply.status, 400);
  EXPECT_EQ(reply.contentType, "application/problem+json");
  EXPECT_EQ(reply.headers.front(), (std::pair<std::string, std::string>("Cache-Control", "no-store")));
  const auto body = nlohmann::json::parse(reply.body.view());
  EXPECT_EQ(body["status"], 400);
  EXPECT_EQ(body["instance"], "request-1");
  ASSERT_EQ(body["problems"].size(), 2u);
  EXPECT_EQ(body["problems"][0]["pointer"], "/width");
  EXPECT_EQ(body["problems"][0]["actual"], "9000");
}

TEST(ProblemReply, TellsTheBusyWhenToComeAgain) {
  const HttpReply reply = problemReply({{ProblemCode::busy, "", "Full.", "", ""}}, "x", {.retryAfterSeconds = 7});
  EXPECT_EQ(reply.status, 429);
  EXPECT_EQ(reply.headers.back(), (std::pair<std::string, std::string>("Retry-After", "7")));
}

TEST(ProblemReply, AnIncompleteRequestHasStatusesOfItsOwn) {
  EXPECT_EQ(statusOf(ProblemCode::tooLarge, RequestPart::head), 431);
  EXPECT_EQ(statusOf(ProblemCode::tooLarge, RequestPart::body), 413);
  EXPECT_EQ(statusOf(ProblemCode::deadlineExceeded, RequestPart::head), 408);
  EXPECT_EQ(statusOf(ProblemCode::deadlineExceeded, RequestPart::body), 408);
  EXPECT_EQ(statusOf(ProblemCode::malformed, RequestPart::head), 400);
}

TEST(ProblemReply, OfOtherStatusesSaysWhenToRetryWhereThatIsKnown) {
  const Problems problems{{ProblemCode::internal, "", "No.", "", ""}};
  EXPECT_EQ(problemReply(problems, "x").headers.size(), 1u);
  EXPECT_EQ(problemReply(problems, "x", {.retryAfterSeconds = 7}).headers.back(),
            (std::pair<std::string, std::string>("Retry-After", "7")));
}

TEST(ReplyText, OmitsTheLengthWhereThereIsNone) {
  HttpReply reply;
  reply.body = "12345";
  EXPECT_NE(replyHead(reply, "id", true).find("Content-Length: 5\r\n"), std::string::npos);
  reply.status = 304;
  EXPECT_EQ(replyHead(reply, "id", true).find("Content-Length"), std::string::npos);
}

TEST(ReplyText, LetsNoHeaderBreakOut) {
  HttpReply reply;
  reply.headers.emplace_back("Location", "/a\r\nSet-Cookie: b");
  EXPECT_EQ(replyHead(reply, "id", true).find("\r\nSet-Cookie"), std::string::npos);
}

TEST(ReplyText, KeepsAPolicyThatTheReplyBrings) {
  HttpReply reply;
  reply.headers.emplace_back("Content-Security-Policy", "script-src 'self'");
  const std::string head = replyHead(reply, "id", true);
  EXPECT_EQ(head.find("default-src 'none'"), std::string::npos);
}

/// "image/png", or "multipart/mixed of exr"; "none".
std::string chosen(std::optional<std::string_view> accept, ImageFormat format = ImageFormat::png) {
  const auto form = negotiate(accept, format);
  if (!form) {
    return "none";
  }
  const std::string type(mediaTypeOf(*form));
  return form->form == ReplyForm::image ? type : type + " of " + std::string(spell(form->format));
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

TEST(Negotiation, EveryFormatHasItsType) {
  for (const FormatTraits& traits : kFormatTraits) {
    EXPECT_EQ(chosen(traits.mediaType, ImageFormat::png), traits.mediaType);
    EXPECT_EQ(chosen(traits.mediaType, ImageFormat::tiff), traits.mediaType);
    EXPECT_EQ(chosen("*/*", traits.format), traits.mediaType);
    EXPECT_EQ(chosen(std::nullopt, traits.format), traits.mediaType);
    EXPECT_EQ(chosen("multipart/mixed", traits.format), "multipart/mixed of " + std::string(spell(traits.format)));
  }
  EXPECT_EQ(kFrameTypes.size(), kFormatTraits.size() + 2);
}

/// What they send for a picture of a page, and Chrome and Firefox for a page.
TEST(Negotiation, BrowsersGetWhatTheSpecSays) {
  for (const char* accept :
       {"image/avif,image/webp,image/apng,image/svg+xml,image/*,*/*;q=0.8",
        "image/avif,image/webp,image/png,image/svg+xml,image/*;q=0.8,*/*;q=0.5", "image/avif,image/webp,*/*",
        "image/webp,image/avif,image/jxl,image/heic,image/heic-sequence,video/*;q=0.8,image/png,image/svg+xml,"
        "image/*;q=0.8,*/*;q=0.5",
        "text/html,application/xhtml+xml,application/xml;q=0.9,image/avif,image/webp,image/apng,*/*;q=0.8"}) {
    for (const FormatTraits& traits : kFormatTraits)
      EXPECT_EQ(chosen(accept, traits.format), traits.mediaType) << accept;
  }
}

TEST(Negotiation, APreviewIsChosenWhereNothingElseIsTaken) {
  EXPECT_EQ(chosen("image/webp", ImageFormat::png), "image/webp");
  EXPECT_EQ(chosen("image/webp, image/jpeg;q=0.5", ImageFormat::png), "image/webp");
  EXPECT_EQ(chosen("image/jpeg, image/webp", ImageFormat::png), "image/jpeg");
  EXPECT_EQ(chosen("image/jpeg, image/webp", ImageFormat::webp), "image/webp");
  EXPECT_EQ(chosen("image/webp, image/png;q=0.1", ImageFormat::png), "image/png") << "as browsers might";
  EXPECT_EQ(chosen("image/png, application/json;q=0.5, */*;q=0.1", ImageFormat::exr), "image/x-exr");
}

TEST(Negotiation, ArraysAreChosenOnlyWhereTheyAreAskedFor) {
  EXPECT_EQ(chosen("application/x-npy, */*;q=0.1", ImageFormat::png), "application/x-npy");
  EXPECT_EQ(chosen("application/*", ImageFormat::png), "application/json of png");
  EXPECT_EQ(chosen("application/*", ImageFormat::npz), "application/zip");
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
       {"text/html", "image/png;q=0", "image/avif, image/gif", "*/*;q=0", "image/png;q=x", ",;,"}) {
    EXPECT_EQ(chosen(accept), "none") << accept;
  }
}

Precondition unlessKnown(const std::string& ifNoneMatch, std::string_view etag) {
  return preconditionOf({{"if-none-match", ifNoneMatch}}, etag);
}

Precondition only(const std::string& ifMatch, std::string_view etag) {
  return preconditionOf({{"if-match", ifMatch}}, etag);
}

TEST(Preconditions, IfNoneMatchListsTagsAndComparesWeakly) {
  for (const char* list : {"\"a\"", "\"x\", W/\"a\" ,\"y\""}) {
    EXPECT_EQ(unlessKnown(list, "\"a\""), Precondition::known) << list;
    EXPECT_EQ(unlessKnown(list, "W/\"a\""), Precondition::known) << list;
  }
  for (const char* list : {"", "a", "\"b\", \"c\""}) {
    EXPECT_EQ(unlessKnown(list, "\"a\""), Precondition::holds) << list;
  }
  EXPECT_EQ(unlessKnown(" * ", "\"a\""), Precondition::exists);
  EXPECT_EQ(unlessKnown("", ""), Precondition::holds);
}

TEST(Preconditions, IfMatchComparesStronglyAndComesFirst) {
  EXPECT_EQ(only("\"x\", \"a\"", "\"a\""), Precondition::holds);
  EXPECT_EQ(only("*", "\"a\""), Precondition::holds);
  EXPECT_EQ(only("*", ""), Precondition::holds);
  EXPECT_EQ(only("\"x\"", "\"a\""), Precondition::failed);
  EXPECT_EQ(only("", ""), Precondition::failed);
  EXPECT_EQ(only("W/\"a\"", "W/\"a\""), Precondition::failed) << "weak tags are equal to none";
  EXPECT_EQ(preconditionOf({{"if-none-match", "*"}, {"if-match", "\"x\""}}, "\"a\""), Precondition::failed);
  EXPECT_EQ(preconditionOf({{"if-none-match", "\"a\""}, {"if-match", "\"a\""}}, "\"a\""), Precondition::known);
  EXPECT_EQ(preconditionOf({}, "\"a\""), Precondition::holds);
}

} // namespace
} // namespace gnomon

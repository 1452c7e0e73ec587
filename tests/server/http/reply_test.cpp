#include "server/http/reply.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

TEST(ProblemReply, EveryKindHasItsStatus) {
  const std::map<ProblemCode, int> expected{
      {ProblemCode::malformed, 400},        {ProblemCode::invalidValue, 400},
      {ProblemCode::notFound, 404},         {ProblemCode::methodNotAllowed, 405},
      {ProblemCode::unauthorized, 401},     {ProblemCode::forbidden, 403},
      {ProblemCode::misdirected, 421},      {ProblemCode::insufficientStorage, 507},
      {ProblemCode::notAcceptable, 406},    {ProblemCode::lengthRequired, 411},
      {ProblemCode::tooLarge, 413},         {ProblemCode::unsupportedMediaType, 415},
      {ProblemCode::invalidScene, 422},     {ProblemCode::unsupportedFeature, 422},
      {ProblemCode::hashMismatch, 422},     {ProblemCode::busy, 429},
      {ProblemCode::deadlineExceeded, 504}, {ProblemCode::unavailable, 503},
      {ProblemCode::backend, 500},          {ProblemCode::internal, 500}};
  for (const auto& [code, status] : expected) {
    EXPECT_EQ(statusOf(code), status);
  }
  EXPECT_EQ(expected.size(), static_cast<std::size_t>(ProblemCode::internal) + 1);
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

TEST(ProblemReply, SaysWhenToRetryOnlyToTheBusy) {
  const HttpReply reply = problemReply({{ProblemCode::notFound, "", "No.", "", ""}}, "x", {.retryAfterSeconds = 7});
  EXPECT_EQ(reply.headers.size(), 1u);
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

} // namespace
} // namespace gnomon

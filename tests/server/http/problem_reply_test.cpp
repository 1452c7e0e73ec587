#include "server/http/problem_reply.h"

#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

TEST(ProblemReply, EveryKindHasItsStatus) {
  const std::map<ProblemCode, int> expected{
      {ProblemCode::malformed, 400},        {ProblemCode::invalidValue, 400},
      {ProblemCode::notFound, 404},         {ProblemCode::methodNotAllowed, 405},
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
  const auto body = nlohmann::json::parse(reply.body);
  EXPECT_EQ(body["status"], 400);
  EXPECT_EQ(body["instance"], "request-1");
  ASSERT_EQ(body["problems"].size(), 2u);
  EXPECT_EQ(body["problems"][0]["pointer"], "/width");
  EXPECT_EQ(body["problems"][0]["actual"], "9000");
}

TEST(ProblemReply, TellsTheBusyWhenToComeAgain) {
  const HttpReply reply = busyReply({{ProblemCode::busy, "", "Full.", "", ""}}, "x", 7);
  EXPECT_EQ(reply.status, 429);
  EXPECT_EQ(reply.headers.back(), (std::pair<std::string, std::string>("Retry-After", "7")));
}

} // namespace
} // namespace gnomon

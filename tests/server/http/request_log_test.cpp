#include "server/http/request_log.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gnomon {
namespace {

TEST(RequestLog, IsOneJsonLine) {
  RequestRecord record;
  record.id = "1";
  record.target = "/\xff\n\"" + std::string(10'000, 'a');
  HttpReply reply;
  reply.stages = {{"queue", 1.5}};
  const std::string line = requestLine(record, reply, 2);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_LT(line.size(), 1000u);
  const auto json = nlohmann::json::parse(line);
  EXPECT_EQ(json["stages"]["queue"], 1.5);
  EXPECT_EQ(json["status"], 200);
}

TEST(RequestLog, HoldsNoSignatureThatAReaderCouldUse) {
  RequestRecord record;
  record.target = "/v1/scenes/x/frame?width=9&expires=1&key=a&signature=0123";
  const auto told = nlohmann::json::parse(requestLine(record, {}, 1));
  EXPECT_EQ(told["target"], "/v1/scenes/x/frame?width=9&expires=1&key=a&");
}

TEST(RequestLog, KeepsTheClientsSentenceApartFromTheCause) {
  HttpReply reply;
  reply.problem = "An internal error occurred.";
  const auto told = nlohmann::json::parse(requestLine({}, reply, 1));
  EXPECT_EQ(told["problem"], "An internal error occurred.");
  EXPECT_FALSE(told.contains("note"));
  reply.note = "bad_alloc";
  EXPECT_EQ(nlohmann::json::parse(requestLine({}, reply, 1))["note"], "bad_alloc");
}

} // namespace
} // namespace gnomon

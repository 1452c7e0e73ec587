#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "server/frames/frame_reply.h"
#include "server/http/reply_text.h"
#include "server/http/request_id.h"
#include "server/http/request_log.h"

namespace gnomon {
namespace {

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

TEST(RequestId, TakesWellFormedOnesAndMakesTheOthers) {
  EXPECT_EQ(requestId("a-B_1.:2"), "a-B_1.:2");
  for (const std::string& bad : {std::string(), std::string("a b"), std::string("a\nb"), std::string(129, 'a')}) {
    EXPECT_EQ(requestId(bad).size(), 16u);
  }
  EXPECT_NE(requestId(std::nullopt), requestId(std::nullopt));
}

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

TEST(FrameReply, TellsTheStages) {
  EXPECT_EQ(serverTiming({{"queue", 0.1234}, {"load", 12}}), "queue;dur=0.123, load;dur=12.000");
  EXPECT_EQ(serverTiming({}), "");
}

} // namespace
} // namespace gnomon

#include "server/http/request_log.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck/gtest.h>
#include <regex>
#include <set>

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

TEST(RequestLog, HoldsNoSignatureThatTheClientHasSpeltOtherwise) {
  const std::string path = "/v1/scenes/x/frame?width=9&";
  for (const char* spelling : {"%73ignature=0123", "signature%3d0123", "SIGNATURE=0123", "si%67n%61ture=0123",
                               "%2573ignature=0123", "%25%37%33ignature=0123", "%2%35%37%33ignature=0123"}) {
    RequestRecord record;
    record.target = path + spelling + "&height=9";
    const auto line = nlohmann::json::parse(requestLine(record, {}, 1));
    EXPECT_EQ(line["target"].get<std::string>().find("0123"), std::string::npos) << line["target"];
  }
  RequestRecord record;
  record.target = path + "sun=1%2C2&camera.node=%zz&";
  EXPECT_EQ(nlohmann::json::parse(requestLine(record, {}, 1))["target"], record.target);
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

TEST(RequestLog, SaysWhyAReplyWasNotSentWhole) {
  const auto logged = [](Delivery delivery) {
    RequestRecord record;
    record.delivery = delivery;
    return nlohmann::json::parse(requestLine(record, {}, 1)).value("undelivered", "nothing");
  };
  EXPECT_EQ(logged(Delivery::whole), "nothing");
  EXPECT_EQ(logged(Delivery::clientLeft), "clientLeft");
  EXPECT_EQ(logged(Delivery::tooSlow), "tooSlow");
  EXPECT_EQ(logged(Delivery::othersWaited), "othersWaited");
  EXPECT_EQ(logged(Delivery::shutdown), "shutdown");
}

const std::string kTrace = "0af7651916cd43dd8448eb211c80319c";
const std::string kParent = "b7ad6b7169203331";

TraceContext of(const std::string& traceparent) {
  return traceOf({{"traceparent", traceparent}});
}

bool isWellFormed(const TraceContext& trace) {
  return std::regex_match(trace.traceId, std::regex("[0-9a-f]{32}")) &&
         std::regex_match(trace.spanId, std::regex("[0-9a-f]{16}"));
}

TEST(TraceContext, GoesOnFromItsSender) {
  for (const char* flags : {"00", "01", "02", "03", "ff"}) {
    const TraceContext trace = of("00-" + kTrace + "-" + kParent + "-" + flags);
    EXPECT_EQ(trace.traceId, kTrace);
    EXPECT_EQ(trace.parentId, kParent);
    EXPECT_NE(trace.spanId, kParent);
    EXPECT_TRUE(isWellFormed(trace));
    const bool isOdd = flags[1] == '1' || flags[1] == '3' || flags[1] == 'f';
    EXPECT_EQ(trace.sampled, isOdd) << flags;
    EXPECT_EQ(traceResponse(trace), "00-" + kTrace + "-" + trace.spanId + (isOdd ? "-01" : "-00"));
  }
}

TEST(TraceContext, ReadsTheBeginningOfLaterVersions) {
  EXPECT_EQ(of("cc-" + kTrace + "-" + kParent + "-01").traceId, kTrace);
  EXPECT_EQ(of("01-" + kTrace + "-" + kParent + "-01-what-the-future-adds").parentId, kParent);
  EXPECT_NE(of("01-" + kTrace + "-" + kParent + "-01.what").traceId, kTrace);
}

TEST(TraceContext, BeginsAnewWhereTheHeaderIsMalformed) {
  std::string upper = kTrace;
  upper[1] = 'A';
  const std::string good = "00-" + kTrace + "-" + kParent + "-01";
  for (const std::string& bad :
       {std::string(), good + "-00", good + " ", good + ", " + good, good.substr(1), good.substr(0, good.size() - 1),
        "ff-" + kTrace + "-" + kParent + "-01", "0x-" + kTrace + "-" + kParent + "-01",
        "00-" + upper + "-" + kParent + "-01", "00-" + std::string(32, '0') + "-" + kParent + "-01",
        "00-" + kTrace + "-" + std::string(16, '0') + "-01", "00-" + kTrace + "-" + kParent + "-0x",
        "00_" + kTrace + "-" + kParent + "-01", "00-" + kTrace + "_" + kParent + "-01",
        "00-" + kTrace + "-" + kParent + "_01"}) {
    const TraceContext trace = of(bad);
    EXPECT_NE(trace.traceId, kTrace) << bad;
    EXPECT_TRUE(isWellFormed(trace)) << bad;
    EXPECT_EQ(trace.parentId, "") << bad;
    EXPECT_FALSE(trace.sampled) << bad;
  }
  EXPECT_NE(traceOf({{"traceparent", good}, {"traceparent", good}}).traceId, kTrace) << "which of them?";
}

TEST(TraceContext, IdsDiffer) {
  std::set<std::string> ids;
  for (int i = 0; i < 1000; ++i) {
    const TraceContext trace = traceOf({});
    ids.insert(trace.traceId);
    ids.insert(trace.spanId);
  }
  EXPECT_EQ(ids.size(), 2000u);
}

RC_GTEST_PROP(TraceContext, AnyBytesGiveAWellFormedTrace, (const std::string& bytes)) {
  RC_ASSERT(isWellFormed(of(bytes)));
}

} // namespace
} // namespace gnomon

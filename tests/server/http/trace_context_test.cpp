#include "server/http/trace_context.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <regex>
#include <set>

namespace gnomon {
namespace {

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

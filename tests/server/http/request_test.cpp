#include "server/http/request.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon {
namespace {

Result<RequestHead> parsed(const std::string& lines) {
  return parseRequestHead(lines + "\r\n");
}

TEST(RequestHead, ReadsLineAndHeaders) {
  const auto head = parsed("GET /a?b=c HTTP/1.1\r\nHost: x\r\nACCEPT:  image/png \r\nX-Empty:\r\n");
  ASSERT_TRUE(head);
  EXPECT_EQ(head->method, "GET");
  EXPECT_EQ(head->target, "/a?b=c");
  EXPECT_EQ(headerValue(head->headers, "accept"), "image/png");
  EXPECT_EQ(headerValue(head->headers, "x-empty"), "");
  EXPECT_TRUE(head->keepAlive);
  EXPECT_FALSE(head->contentLength);
}

TEST(RequestHead, JoinsRepeatedHeaders) {
  const auto head = parsed("GET / HTTP/1.1\r\nHost: x\r\nAccept: a/b\r\nAccept: c/d\r\n");
  ASSERT_TRUE(head);
  EXPECT_EQ(headerValue(head->headers, "accept"), "a/b, c/d");
}

TEST(RequestHead, KnowsWhetherTheConnectionStays) {
  EXPECT_FALSE(parsed("GET / HTTP/1.1\r\nHost: x\r\nConnection: foo, Close\r\n")->keepAlive);
  EXPECT_FALSE(parsed("GET / HTTP/1.0\r\n")->keepAlive);
  EXPECT_TRUE(parsed("GET / HTTP/1.0\r\nConnection: keep-alive\r\n")->keepAlive);
}

TEST(RequestHead, ReadsFraming) {
  EXPECT_EQ(parsed("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 12\r\n")->contentLength, 12u);
  EXPECT_TRUE(parsed("POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: Chunked\r\n")->chunked);
  EXPECT_TRUE(parsed("POST / HTTP/1.1\r\nHost: x\r\nExpect: 100-continue\r\n")->expectsContinue);
}

TEST(RequestHead, CutsAnAbsoluteTarget) {
  EXPECT_EQ(parsed("GET http://proxy.example:80/a?b HTTP/1.1\r\nHost: x\r\n")->target, "/a?b");
  EXPECT_EQ(parsed("GET http://proxy.example HTTP/1.1\r\nHost: x\r\n")->target, "/");
  EXPECT_EQ(parsed("GET HTTP://proxy.example/a HTTP/1.1\r\nHost: x\r\n")->target, "/a");
  EXPECT_EQ(parsed("GET http://proxy.example?b=/c HTTP/1.1\r\nHost: x\r\n")->target, "/?b=/c");
  EXPECT_EQ(headerValue(parsed("GET http://a.example:80/ HTTP/1.1\r\nHost: x\r\n")->headers, "host"), "a.example:80");
}

TEST(RequestHead, PassesOverOneEmptyLine) {
  EXPECT_TRUE(parsed("\r\nGET / HTTP/1.1\r\nHost: x\r\n"));
  EXPECT_FALSE(parsed("\r\n\r\nGET / HTTP/1.1\r\nHost: x\r\n"));
}

class RefusedHead : public ::testing::TestWithParam<const char*> {};

TEST_P(RefusedHead, IsMalformed) {
  const auto head = parsed(GetParam());
  ASSERT_FALSE(head);
  EXPECT_EQ(head.problems().front().code, ProblemCode::malformed);
}

INSTANTIATE_TEST_SUITE_P(
    Smuggling, RefusedHead,
    ::testing::Values("POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\nTransfer-Encoding: chunked\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 1\r\nContent-Length: 1\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 1, 1\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: +1\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: -1\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 0x10\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length: 99999999999999999999999\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nContent-Length:\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: gzip, chunked\r\n",
                      "POST / HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: chunked\r\nTransfer-Encoding: chunked\r\n",
                      "POST / HTTP/1.0\r\nTransfer-Encoding: chunked\r\n",
                      "GET / HTTP/1.1\r\nHost: x\r\n folded: y\r\n", "GET / HTTP/1.1\r\nHost : x\r\n",
                      "GET / HTTP/1.1\r\nHost: x\nEvil: y\r\n", "GET / HTTP/1.1\r\nHost: x\r\nA: b\rc\r\n"));

INSTANTIATE_TEST_SUITE_P(
    Form, RefusedHead,
    ::testing::Values("", "GET\r\n", "GET /\r\n", "GET  HTTP/1.1\r\n", "GET / HTTP/2.0\r\nHost: x\r\n",
                      "GET / HTTP/1.1\r\n", "GET / HTTP/1.1\r\nHost: x\r\nHost: y\r\n", "GET a HTTP/1.1\r\nHost: x\r\n",
                      "GET /\x80 HTTP/1.1\r\nHost: x\r\n", "G@T / HTTP/1.1\r\nHost: x\r\n",
                      "GET / / HTTP/1.1\r\nHost: x\r\n", "AVERYLONGMETHODNAME / HTTP/1.1\r\nHost: x\r\n",
                      "GET / HTTP/1.1\r\nHost: x\r\nno colon\r\n", "GET / HTTP/1.1\r\nHost: x\r\n: nameless\r\n"));

TEST(RequestHead, RefusesTooManyHeaders) {
  std::string lines = "GET / HTTP/1.1\r\nHost: x\r\n";
  for (std::size_t i = 0; i < kMaxHeaders; ++i) {
    lines += "a: b\r\n";
  }
  const auto head = parsed(lines);
  ASSERT_FALSE(head);
  EXPECT_EQ(head.problems().front().code, ProblemCode::tooLarge);
}

TEST(RequestHead, FindsItsEnd) {
  EXPECT_EQ(headLength("GET / HTTP/1.1\r\n\r\nbody"), 18u);
  EXPECT_FALSE(headLength("GET / HTTP/1.1\r\n\r"));
  EXPECT_FALSE(headLength("GET / HTTP/1.1\r\nHost: x\r\n"));
  EXPECT_EQ(headLength("\r\nGET / HTTP/1.1\r\n\r\n"), 20u);
}

TEST(RequestHead, AtALineThatEndsWithLfAloneIsThereToBeRefused) {
  for (const char* bytes : {"GET / HTTP/1.1\nHost: x\n\n", "GET / HTTP/1.1\r\nHost: x\n\r\n", "\n"}) {
    const auto length = headLength(bytes);
    ASSERT_TRUE(length) << bytes;
    const auto head = parseRequestHead(std::string_view(bytes).substr(0, *length));
    ASSERT_FALSE(head) << bytes;
    EXPECT_EQ(head.problems().front().detail, "A line of the head ends with LF alone; CR LF is needed.");
  }
}

TEST(RequestHead, OfOptionsAloneMayNameTheWholeServer) {
  const auto head = parsed("OPTIONS * HTTP/1.1\r\nHost: x\r\n");
  ASSERT_TRUE(head);
  EXPECT_EQ(head->target, kWholeServer);
  EXPECT_TRUE(requestFromHead(*head)->path.empty());
  EXPECT_FALSE(parsed("GET * HTTP/1.1\r\nHost: x\r\n"));
  EXPECT_FALSE(parsed("OPTIONS ** HTTP/1.1\r\nHost: x\r\n"));
}

TEST(HeadExcerpt, IsWhatCanBeReadOfTheFirstLine) {
  const auto excerpt = [](std::string_view bytes) {
    const HeadExcerpt read = excerptOf(bytes);
    return read.method + "|" + read.target;
  };
  EXPECT_EQ(excerpt("\r\nGET /a?b=c HTTP/1.1\r\nno colon\r\n\r\n"), "GET|/a?b=c");
  EXPECT_EQ(excerpt("GET /a HTTP/1.1\nHost: x\n"), "GET|/a");
  EXPECT_EQ(excerpt("POST /a\x01\xff b HTTP/1.1\r\n"), "POST|/a???b");
  EXPECT_EQ(excerpt("DELETE"), "DELETE|");
  EXPECT_EQ(excerpt("GET /half"), "GET|/half");
  EXPECT_EQ(excerpt("\x16\x03\x01 /a HTTP/1.1\r\n"), "|") << "a client that speaks TLS";
  EXPECT_EQ(excerpt(""), "|");
}

TEST(RequestHead, SurvivesAnything) {
  EXPECT_TRUE(rc::check([](const std::string& noise) {
    const auto head = parseRequestHead("GET / HTTP/1.1\r\nHost: x\r\n" + noise + "\r\n\r\n");
    if (head) {
      for (const auto& [name, value] : head->headers) {
        RC_ASSERT(value.find_first_of(std::string_view("\r\n\0", 3)) == std::string::npos);
      }
    }
  }));
}

TEST(RequestId, TakesWellFormedOnesAndMakesTheOthers) {
  EXPECT_EQ(requestId("a-B_1.:2"), "a-B_1.:2");
  for (const std::string& bad : {std::string(), std::string("a b"), std::string("a\nb"), std::string(129, 'a')}) {
    EXPECT_EQ(requestId(bad).size(), 16u);
  }
  EXPECT_NE(requestId(std::nullopt), requestId(std::nullopt));
}

TEST(Router, ReadsMediaTypes) {
  EXPECT_EQ(mediaType("Model/GLTF+json ; charset=utf-8"), "model/gltf+json");
  EXPECT_EQ(mediaType(""), "");
}

} // namespace
} // namespace gnomon

#include "server/http/request_body.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <thread>

#include "server/http/multipart.h"
#include "server/http/reply.h"
#include "tests/server/http/connection_fixture.h"

namespace gnomon {
namespace {

using Framing = BodyRule::Framing;
using ReadBody = Result<Bytes>;

/// What the server makes of `sent`; the client hangs up after it unless `staying`.
ReadBody received(const std::string& sent, RequestHead head, BodyRule rule, bool staying = false, Pace pace = {}) {
  SocketPair pair;
  std::thread client([&] {
    sendAll(pair.client.get(), sent, Pace{});
    if (!staying) {
      ::shutdown(pair.client.get(), SHUT_WR);
    }
  });
  SocketReader reader(pair.server.get());
  ByteBudget budget(1 << 20);
  ByteLease lease(budget);
  ReadBody outcome = readBody(reader, head, rule, pace, lease);
  pair.server.reset();
  client.join();
  return outcome;
}

RequestHead chunkedHead() {
  RequestHead head;
  head.chunked = true;
  return head;
}

RequestHead lengthHead(std::uint64_t length) {
  RequestHead head;
  head.contentLength = length;
  return head;
}

int statusOf(const ReadBody& outcome) {
  return outcome ? 200 : statusOf(outcome.problems().front().code, RequestPart::body);
}

std::string bodyOf(const ReadBody& outcome) {
  return outcome ? std::string(outcome->begin(), outcome->end()) : "refused";
}

TEST(RequestBody, ReadsALength) {
  EXPECT_EQ(bodyOf(received("hello, and the next request", lengthHead(5), {Framing::any, 10})), "hello");
}

TEST(RequestBody, ReadsChunks) {
  const std::string sent = "5\r\nhello\r\n1 \t;ext=1\r\n,\r\nA\r\n0123456789\r\n0\r\nTrailer: x\r\n\r\n";
  EXPECT_EQ(bodyOf(received(sent, chunkedHead(), {Framing::any, 16})), "hello,0123456789");
}

TEST(RequestBody, CountsChunks) {
  const std::string sent = "5\r\nhello\r\nA\r\n0123456789\r\n0\r\n\r\n";
  EXPECT_EQ(statusOf(received(sent, chunkedHead(), {Framing::any, 14})), 413);
  EXPECT_EQ(statusOf(received("ffffffffffffffff\r\n", chunkedHead(), {Framing::any, 14})), 413);
  EXPECT_EQ(statusOf(received("fffffffffffffffff\r\n", chunkedHead(), {Framing::any, 14})), 400);
}

TEST(RequestBody, RefusesBrokenChunks) {
  for (const char* sent : {"x\r\n", "\r\n", "-5\r\nhello\r\n0\r\n\r\n", "0x5\r\nhello\r\n", "5\r\nhelloo\r\n0\r\n\r\n",
                           "5\r\nhel", "5\r\nhello\r\n", "5 5\r\nhello\r\n0\r\n\r\n", "5;a\nb\r\nhello\r\n0\r\n\r\n",
                           "5;\r;\r\nhello\r\n0\r\n\r\n", "0\r\nTrailer: x\n\n\r\n\r\n"}) {
    EXPECT_EQ(statusOf(received(sent, chunkedHead(), {Framing::any, 100})), 400) << sent;
  }
  EXPECT_EQ(statusOf(received(std::string(3000, '1'), chunkedHead(), {Framing::any, 100})), 400);
}

TEST(RequestBody, LimitsAChunksLineHoweverItComes) {
  const auto with = [](std::size_t lineBytes) {
    return "5;" + std::string(lineBytes - 2, 'x') + "\r\nhello\r\n0\r\n\r\n";
  };
  EXPECT_EQ(bodyOf(received(with(1024), chunkedHead(), {Framing::any, 100})), "hello");
  EXPECT_EQ(statusOf(received(with(1025), chunkedHead(), {Framing::any, 100})), 400);
}

TEST(RequestBody, RefusesALengthThatLied) {
  EXPECT_EQ(statusOf(received("short", lengthHead(10), {Framing::any, 100})), 400);
}

TEST(RequestBody, RefusesTheSlow) {
  Pace pace;
  pace.first = std::chrono::milliseconds(20);
  EXPECT_EQ(statusOf(received("slow", lengthHead(10), {Framing::any, 100}, true, pace)), 408);
}

TEST(RequestBody, ABurstEarnsNoTimeForDripping) {
  constexpr Pace kPace{std::chrono::milliseconds(500), std::chrono::milliseconds(200), 1000};
  SocketPair pair;
  std::thread client([&] {
    std::string piece(100'000, 'x'); // at 1,000 bytes a second it would earn 100 seconds
    while (sendAll(pair.client.get(), piece, Pace{})) {
      piece = "x";
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  });
  SocketReader reader(pair.server.get());
  ByteBudget budget(1 << 20);
  ByteLease lease(budget);
  const auto start = Clock::now();
  EXPECT_EQ(statusOf(readBody(reader, lengthHead(200'000), {Framing::any, 200'000}, kPace, lease)), 408);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(10));
  pair.server.reset();
  client.join();
}

TEST(RequestBody, RefusesByTheHeadAlone) {
  const auto status = [](const RequestHead& head, BodyRule rule) {
    const auto refusal = refuseBody(head, rule, 1000);
    return refusal ? statusOf(refusal->code, RequestPart::body) : 200;
  };
  EXPECT_EQ(status(lengthHead(11), {Framing::any, 10}), 413);
  EXPECT_EQ(status(lengthHead(10), {Framing::any, 10}), 200);
  EXPECT_EQ(status(RequestHead{}, {Framing::any, 10}), 411);
  EXPECT_EQ(status(RequestHead{}, {Framing::length, 10}), 200);
  EXPECT_EQ(status(chunkedHead(), {Framing::length, 10}), 411);
  EXPECT_EQ(status(chunkedHead(), {Framing::any, 10}), 200);
  EXPECT_EQ(status(chunkedHead(), {Framing::none, 0}), 413);
  EXPECT_EQ(status(lengthHead(1), {Framing::none, 0}), 413);
  EXPECT_EQ(status(lengthHead(0), {Framing::none, 0}), 200);
  EXPECT_EQ(status(lengthHead(1000), {Framing::any, 2000}), 200);
  EXPECT_EQ(status(lengthHead(1001), {Framing::any, 2000}), 413) << "larger than all bodies may be";
}

TEST(RequestBody, ChunksThatCanNeverFitAreTooLargeAndNotEarly) {
  SocketPair pair;
  ASSERT_TRUE(sendAll(pair.client.get(), "5\r\nhello\r\n6\r\n", Pace{}));
  SocketReader reader(pair.server.get());
  ByteBudget budget(10);
  ByteLease lease(budget);
  const ReadBody outcome = readBody(reader, chunkedHead(), {Framing::any, 100}, {}, lease);
  EXPECT_EQ(statusOf(outcome), 413);
  EXPECT_EQ(outcome.problems().front().limit, "10 bytes");
}

TEST(RequestBody, SharesABudgetAndGivesItBack) {
  ByteBudget budget(16);
  ByteLease others(budget);
  ASSERT_TRUE(others.grow(6));
  {
    SocketPair pair;
    ASSERT_TRUE(sendAll(pair.client.get(), "0123456789ab", Pace{}));
    SocketReader reader(pair.server.get());
    ByteLease lease(budget);
    EXPECT_EQ(statusOf(readBody(reader, lengthHead(12), {Framing::any, 100}, {}, lease)), 429);
  }
  EXPECT_EQ(budget.used(), others.held());
}

TEST(RequestBody, AnyChunkingGivesTheSameBody) {
  EXPECT_TRUE(rc::check([](const std::vector<std::string>& chunks) {
    std::string sent, whole;
    for (const std::string& chunk : chunks) {
      if (!chunk.empty()) {
        char size[20];
        std::snprintf(size, sizeof size, "%zx\r\n", chunk.size());
        sent += size + chunk + "\r\n";
        whole += chunk;
      }
    }
    const ReadBody outcome = received(sent + "0\r\n\r\n", chunkedHead(), {Framing::any, whole.size()});
    RC_ASSERT(bodyOf(outcome) == whole);
  }));
}

std::string part(const std::string& disposition, const std::string& content) {
  return "--B\r\nContent-Disposition: form-data; " + disposition + "\r\n\r\n" + content + "\r\n";
}

TEST(Multipart, ReadsTheBoundary) {
  EXPECT_EQ(boundaryOf("multipart/form-data; boundary=abc"), "abc");
  EXPECT_EQ(boundaryOf("multipart/form-data; charset=x; Boundary=\"a b:c\""), "a b:c");
  EXPECT_FALSE(boundaryOf("multipart/form-data"));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary="));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary=" + std::string(71, 'a')));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary=\"a\r\nb\""));
  EXPECT_FALSE(boundaryOf("multipart/form-data; boundary=\"abc"));
}

TEST(Multipart, ReadsParts) {
  const std::string body = part("name=\"a\"", "1\r\n2") + part("name=\"b c\"; filename=\"d\\\"e%22.bin\"", "--B") +
                           "--B\r\nCONTENT-TYPE: text/x\r\ncontent-disposition: form-data; name=c\r\n\r\n\r\n--B--\r\n";
  const auto parts = parseMultipart(body, "B", 3);
  ASSERT_TRUE(parts);
  ASSERT_EQ(parts->size(), 3u);
  EXPECT_EQ((*parts)[0].name, "a");
  EXPECT_EQ((*parts)[0].content, "1\r\n2");
  EXPECT_FALSE((*parts)[0].fileName);
  EXPECT_EQ((*parts)[1].name, "b c");
  EXPECT_EQ((*parts)[1].fileName, "d\"e\".bin");
  EXPECT_EQ((*parts)[1].content, "--B");
  EXPECT_EQ((*parts)[2].contentType, "text/x");
  EXPECT_EQ((*parts)[2].content, "");
}

TEST(Multipart, RefusesWhatIsBroken) {
  for (const std::string& body :
       {std::string(), std::string("--B"), std::string("--A--\r\n"), part("name=a", "x"), part("name=a", "x") + "--B",
        part("name=a", "x") + "--Bx--", part("filename=a", "x") + "--B--", part("name=a; name=b", "x") + "--B--",
        part("name=a; size=3", "x") + "--B--", part("name=\"a", "x") + "--B--", part("name=", "x") + "--B--",
        part("name=a", "x") + "--B--\r\nmore", std::string("--B\r\n\r\nx\r\n--B--"),
        std::string("--B\r\nContent-Disposition: attachment; name=a\r\n\r\nx\r\n--B--"),
        std::string(
            "--B\r\nContent-Disposition: form-data; name=a\r\nContent-Disposition: form-data; name=b\r\n\r\nx\r\n"
            "--B--"),
        std::string("--B\r\nContent-Disposition: form-data; name=a\r\nContent-Transfer-Encoding: base64\r\n\r\nx\r\n"
                    "--B--"),
        std::string("--B\r\nContent-Disposition: form-data; name=a")}) {
    const auto parts = parseMultipart(body, "B", 8);
    ASSERT_FALSE(parts) << body;
    EXPECT_EQ(parts.problems().front().code, ProblemCode::malformed) << body;
  }
}

TEST(Multipart, BoundsTheParts) {
  const auto parts = parseMultipart(part("name=a", "") + part("name=b", "") + "--B--", "B", 1);
  ASSERT_FALSE(parts);
  EXPECT_EQ(parts.problems().front().code, ProblemCode::tooLarge);
}

TEST(Multipart, SurvivesAnything) {
  EXPECT_TRUE(rc::check([](const std::string& a, const std::string& b) {
    const std::string body = "--B\r\nContent-Disposition: form-data; name=" + a + "\r\n\r\n" + b + "\r\n--B--";
    const auto parts = parseMultipart(body, "B", 4);
    if (parts) {
      RC_ASSERT(!parts->empty());
    }
  }));
}

} // namespace
} // namespace gnomon

#include "server/http/origin_check.h"

#include <gtest/gtest.h>
#include <optional>

namespace gnomon {
namespace {

/// Answers 200; OPTIONS 204 with Allow, and "/probe" as a probe.
HttpService inner() {
  return [](const HttpRequest& head) -> std::variant<RequestHandler, HttpReply> {
    if (head.method == "OPTIONS") {
      HttpReply reply;
      reply.status = 204;
      reply.headers.emplace_back("Allow", "GET, OPTIONS, POST");
      return reply;
    }
    RequestHandler handler;
    handler.isProbe = head.path == std::vector<std::string>{"probe"};
    handler.answer = [](HttpRequest, const std::function<bool()>&) { return HttpReply{}; };
    return handler;
  };
}

HttpReply ask(const OriginRules& rules, const std::string& method, const Headers& headers,
              const std::vector<std::string>& path = {}) {
  HttpRequest request;
  request.method = method;
  request.path = path;
  request.headers = headers;
  auto found = withOriginCheck(inner(), rules)(request);
  if (auto* reply = std::get_if<HttpReply>(&found)) {
    return *reply;
  }
  return std::get<RequestHandler>(found).answer(request, [] { return false; });
}

std::optional<std::string> header(const HttpReply& reply, const std::string& name) {
  for (const auto& [key, value] : reply.headers) {
    if (key == name) return value;
  }
  return std::nullopt;
}

const OriginRules kLoopback{{}, {}, "127.0.0.1"};

TEST(OriginCheck, ANameThatIsNotTheServersIsMisdirected) {
  const OriginRules named{{"Render.example", "other.example:81"}, {}, "192.168.0.7"};
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "[::1]:8080", "localhost", "LocalHost:8080", "10.0.0.1"}) {
    EXPECT_EQ(ask(kLoopback, "GET", {{"host", host}}).status, 200) << host;
  }
  for (const char* host : {"rebound.example", "localhost.evil.example", "127.0.0.1.evil.example:8080", "x", "[x]"}) {
    EXPECT_EQ(ask(kLoopback, "GET", {{"host", host}}).status, 421) << host;
  }
  for (const char* host : {"render.example", "RENDER.example:8080", "other.example:81", "192.168.0.7"}) {
    EXPECT_EQ(ask(named, "GET", {{"host", host}}).status, 200) << host;
  }
  EXPECT_EQ(ask(named, "GET", {{"host", "other.example:82"}}).status, 421);
}

TEST(OriginCheck, AServerOnEveryAddressIsKnownByAnyNameUnlessItsNamesAreGiven) {
  EXPECT_EQ(ask({{}, {}, "0.0.0.0"}, "GET", {{"host", "render.example"}}).status, 200);
  EXPECT_EQ(ask({{}, {}, "::"}, "GET", {{"host", "render.example"}}).status, 200);
  EXPECT_EQ(ask({{"render.example"}, {}, "::"}, "GET", {{"host", "evil.example"}}).status, 421);
}

TEST(OriginCheck, ProbesAreAnsweredUnderAnyName) {
  EXPECT_EQ(ask(kLoopback, "GET", {{"host", "balancer.example"}}, {"probe"}).status, 200);
}

TEST(OriginCheck, APageOfAnotherServerChangesNothing) {
  const Headers host{{"host", "127.0.0.1:8080"}};
  const auto with = [&](const std::string& name, const std::string& value) {
    Headers headers = host;
    headers.emplace_back(name, value);
    return headers;
  };
  for (const char* method : {"POST", "PUT", "DELETE"}) {
    EXPECT_EQ(ask(kLoopback, method, host).status, 200) << "no browser";
    EXPECT_EQ(ask(kLoopback, method, with("origin", "http://127.0.0.1:8080")).status, 200);
    EXPECT_EQ(ask(kLoopback, method, with("origin", "https://127.0.0.1:8080")).status, 200) << "behind TLS";
    EXPECT_EQ(ask(kLoopback, method, with("origin", "http://127.0.0.1:81")).status, 403);
    EXPECT_EQ(ask(kLoopback, method, with("origin", "http://evil.example")).status, 403);
    EXPECT_EQ(ask(kLoopback, method, with("origin", "null")).status, 403);
    EXPECT_EQ(ask(kLoopback, method, with("sec-fetch-site", "cross-site")).status, 403);
    EXPECT_EQ(ask(kLoopback, method, with("sec-fetch-site", "same-origin")).status, 200);
  }
  EXPECT_EQ(ask(kLoopback, "GET", with("origin", "http://evil.example")).status, 200);
  EXPECT_FALSE(header(ask(kLoopback, "GET", with("origin", "http://evil.example")), "Access-Control-Allow-Origin"));
}

TEST(OriginCheck, PagesThatTheOperatorAllowsMayAskAndRead) {
  const OriginRules rules{{}, {"https://page.example"}, "127.0.0.1"};
  const Headers allowed{{"host", "localhost"}, {"origin", "https://page.example"}};
  const HttpReply post = ask(rules, "POST", allowed);
  EXPECT_EQ(post.status, 200);
  EXPECT_EQ(header(post, "Access-Control-Allow-Origin"), "https://page.example");
  const HttpReply preflight = ask(rules, "OPTIONS", allowed);
  EXPECT_EQ(preflight.status, 204);
  EXPECT_EQ(header(preflight, "Access-Control-Allow-Methods"), "GET, OPTIONS, POST");

  const Headers other{{"host", "localhost"}, {"origin", "https://evil.example"}};
  EXPECT_EQ(ask(rules, "POST", other).status, 403);
  EXPECT_FALSE(header(ask(rules, "OPTIONS", other), "Access-Control-Allow-Methods"));
  EXPECT_EQ(header(ask(rules, "GET", {{"host", "localhost"}}), "Vary"), "Origin")
      << "a shared cache must not hand this reply to an allowed page";
}

} // namespace
} // namespace gnomon

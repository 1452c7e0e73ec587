#include "server/http/client_address.h"

#include <gtest/gtest.h>
#include <optional>
#include <rapidcheck/gtest.h>

#include "server/http/origin_check.h"
#include "tests/server/http/asked.h"

namespace gnomon {
namespace {

std::vector<IpNetwork> networks(const std::vector<std::string>& texts) {
  auto read = ipNetworks(texts);
  EXPECT_TRUE(read) << texts.front();
  return read ? *read : std::vector<IpNetwork>();
}

PeerAddress peer(const std::string& text) {
  return peerAddress(ipAddress(text).value());
}

/// Of a request that the proxy 10.0.0.1 passes on, where 10.0.0.0/8 and fd00::/8 are trusted.
std::string clientOf(const Headers& headers, const std::string& from = "10.0.0.1") {
  return clientAddress(peer(from), headers, networks({"10.0.0.0/8", "fd00::/8"})).text;
}

std::string byList(const std::string& value) {
  return clientOf({{"x-forwarded-for", value}});
}

std::string byPairs(const std::string& value) {
  return clientOf({{"forwarded", value}});
}

TEST(IpNetworks, HoldTheirAddresses) {
  const auto holds = [](const std::string& network, const std::string& address) {
    return networks({network}).front().holds(ipAddress(address).value());
  };
  EXPECT_TRUE(holds("192.0.2.7", "192.0.2.7"));
  EXPECT_FALSE(holds("192.0.2.7", "192.0.2.6"));
  EXPECT_TRUE(holds("10.0.0.0/8", "10.255.0.1"));
  EXPECT_FALSE(holds("10.0.0.0/8", "11.0.0.0"));
  EXPECT_TRUE(holds("192.0.2.128/25", "192.0.2.129"));
  EXPECT_FALSE(holds("192.0.2.128/25", "192.0.2.127"));
  EXPECT_TRUE(holds("0.0.0.0/0", "203.0.113.9"));
  EXPECT_FALSE(holds("0.0.0.0/0", "2001:db8::1"));
  EXPECT_TRUE(holds("2001:db8::/33", "2001:db8:7fff::1"));
  EXPECT_FALSE(holds("2001:db8::/33", "2001:db8:8000::1"));
  EXPECT_TRUE(holds("10.0.0.0/8", "::ffff:10.1.2.3")) << "IPv4 as a socket for both shows it";
}

TEST(IpNetworks, WhatIsNoneIsNamed) {
  for (const char* bad :
       {"", "10", "10.0.0.1/8", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/-1", "10.0.0.0/8x", "2001:db8::/129",
        "2001:db8::1/32", "::ffff:10.0.0.0/104", "proxy.example", "10.0.0.0/8/8", " 10.0.0.1"}) {
    const auto read = ipNetworks({"192.0.2.7", bad});
    ASSERT_FALSE(read) << bad;
    EXPECT_EQ(read.problems().size(), 1u);
    EXPECT_EQ(read.problems().front().actual, bad);
  }
}

TEST(ClientAddress, OfAnUntrustedPeerIsItsOwn) {
  const Headers forged{{"x-forwarded-for", "192.0.2.1"}, {"forwarded", "for=192.0.2.1"}};
  EXPECT_EQ(clientOf(forged, "203.0.113.9"), "203.0.113.9");
  EXPECT_EQ(clientAddress(peer("10.0.0.1"), forged, {}).text, "10.0.0.1");
}

TEST(ClientAddress, IsTheLastThatNoTrustedProxyHas) {
  EXPECT_EQ(byList("192.0.2.1"), "192.0.2.1");
  EXPECT_EQ(byList("203.0.113.9, 192.0.2.1"), "192.0.2.1") << "what stands before it, its client may have sent";
  EXPECT_EQ(byList("203.0.113.9,192.0.2.1 , 10.0.0.7"), "192.0.2.1");
  EXPECT_EQ(byList("10.0.0.9, 10.0.0.8"), "10.0.0.9") << "a client within the trusted network";
  EXPECT_EQ(byList("192.0.2.1:4711"), "192.0.2.1");
  EXPECT_EQ(byList("2001:DB8::1, fd00::2"), "2001:db8::1");
  EXPECT_EQ(byList("[2001:db8::1]:80"), "2001:db8::1");
  EXPECT_EQ(byList("::ffff:192.0.2.1"), "192.0.2.1");
  EXPECT_EQ(clientOf({{"x-forwarded-for", "203.0.113.9"}, {"x-forwarded-for", "192.0.2.1"}}), "192.0.2.1");
}

TEST(ClientAddress, IsReadFromForwarded) {
  EXPECT_EQ(byPairs("for=192.0.2.1"), "192.0.2.1");
  EXPECT_EQ(byPairs("for=203.0.113.9, For=\"192.0.2.1:80\";proto=https;by=10.0.0.1, for=10.0.0.7"), "192.0.2.1");
  EXPECT_EQ(byPairs("proto=https; for=\"[2001:db8::1]:4711\""), "2001:db8::1");
  EXPECT_EQ(byPairs("for=\"192.0.2.1, 203.0.113.9\""), "10.0.0.1") << "a comma within quotes parts nothing";
  EXPECT_EQ(byPairs("for=192.0.2.1;for=203.0.113.9"), "10.0.0.1");
}

TEST(ClientAddress, WhatIsNoAddressEndsTheReading) {
  for (const char* bad :
       {"", ",", "unknown", "_hidden", "192.0.2", "192.0.2.1:99999", "192.0.2.1:", "[192.0.2.1]", "[2001:db8::1",
        "[2001:db8::1]x", "192.0.2.1 203.0.113.9", "fe80::1%eth0", "\"192.0.2.1", "192.0.2.1,"}) {
    EXPECT_EQ(byList(bad), "10.0.0.1") << bad;
    EXPECT_EQ(byPairs(std::string("for=") + bad), "10.0.0.1") << bad;
  }
  EXPECT_EQ(byList("192.0.2.1, nonsense, 10.0.0.7"), "10.0.0.7") << "the proxy that passed the nonsense on";
  EXPECT_EQ(byPairs("for=192.0.2.1, for=\"unended"), "10.0.0.1");
}

TEST(ClientAddress, TwoHeadersHaveToAgree) {
  EXPECT_EQ(clientOf({{"x-forwarded-for", "192.0.2.1"}, {"forwarded", "for=192.0.2.1"}}), "192.0.2.1");
  EXPECT_EQ(clientOf({{"x-forwarded-for", "192.0.2.1"}, {"forwarded", "for=192.0.2.2"}}), "10.0.0.1");
}

TEST(ClientAddress, CountsAnIpv6NetworkAsOneClient) {
  EXPECT_EQ(peer("2001:db8::1").identity, (ClientIdentity{"2001:db8::/64", "2001:db8::/48"}));
  EXPECT_EQ(peer("2001:db8::ffff").identity, peer("2001:db8::1").identity);
  EXPECT_EQ(peer("2001:db8:0:1::1").identity, (ClientIdentity{"2001:db8:0:1::/64", "2001:db8::/48"}));
  EXPECT_EQ(peer("192.0.2.1").identity, (ClientIdentity{"192.0.2.1", "192.0.2.1"}));
}

RC_GTEST_PROP(ClientAddress, AnyHeaderGivesAnAddress, (const std::string& list, const std::string& pairs)) {
  const Headers headers{{"x-forwarded-for", list}, {"forwarded", "for=" + pairs}};
  RC_ASSERT(ipAddress(clientOf(headers)).has_value());
}

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
  return answerOf(withOriginCheck(inner(), rules), request);
}

const OriginRules kLoopback{{}, {}, "127.0.0.1"};

TEST(OriginCheck, ANameThatIsNotTheServersIsMisdirected) {
  const OriginRules named{{"Render.example", "other.example:81"}, {}, "192.168.0.7"};
  for (const char* host : {"127.0.0.1", "127.0.0.1:8080", "[::1]:8080", "localhost", "LocalHost:8080", "10.0.0.1"}) {
    EXPECT_EQ(ask(kLoopback, "GET", {{"host", host}}).status, 200) << host;
  }
  for (const char* host :
       {"rebound.example", "localhost.evil.example", "127.0.0.1.evil.example:8080", "x", "[x]", "[::1].evil.example",
        "[::1]evil", "[::1", "[127.0.0.1]", "[localhost]", "localhost:evil.example"}) {
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
  EXPECT_EQ(header(ask(kLoopback, "GET", with("origin", "http://evil.example")), "Access-Control-Allow-Origin"), "");
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
  EXPECT_EQ(header(ask(rules, "OPTIONS", other), "Access-Control-Allow-Methods"), "");
  EXPECT_EQ(header(ask(rules, "GET", {{"host", "localhost"}}), "Vary"), "Origin")
      << "a shared cache must not hand this reply to an allowed page";
}

} // namespace
} // namespace gnomon

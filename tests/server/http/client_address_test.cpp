#include "server/http/client_address.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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
  EXPECT_EQ(peer("2001:db8::1").network, peer("2001:db8::ffff").network);
  EXPECT_NE(peer("2001:db8:0:1::1").network, peer("2001:db8::1").network);
  EXPECT_EQ(peer("192.0.2.1").network.size(), 4u);
}

RC_GTEST_PROP(ClientAddress, AnyHeaderGivesAnAddress, (const std::string& list, const std::string& pairs)) {
  const Headers headers{{"x-forwarded-for", list}, {"forwarded", "for=" + pairs}};
  RC_ASSERT(ipAddress(clientOf(headers)).has_value());
}

} // namespace
} // namespace gnomon

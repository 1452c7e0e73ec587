#include "server/system/fair_shares.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

ClientIdentity alone(const std::string& name) {
  return {name, name};
}

std::size_t takenBy(FairShares& shares, const ClientIdentity& client) {
  std::size_t count = 0;
  while (shares.take(client)) ++count;
  return count;
}

TEST(FairShares, AClientHasHalfOfWhatOthersLeave) {
  FairShares shares(128);
  EXPECT_EQ(takenBy(shares, alone("192.0.2.1")), 64u);
  EXPECT_EQ(takenBy(shares, alone("192.0.2.2")), 32u);
  EXPECT_EQ(takenBy(shares, alone("192.0.2.3")), 16u);
  EXPECT_FALSE(shares.take(alone("192.0.2.1")));
}

TEST(FairShares, OneIsAllowedWhereOneIsLeft) {
  FairShares shares(2);
  EXPECT_EQ(takenBy(shares, alone("a")), 1u);
  EXPECT_EQ(takenBy(shares, alone("b")), 1u);
  EXPECT_FALSE(shares.take(alone("c")));
  shares.giveBack(alone("a"));
  EXPECT_TRUE(shares.take(alone("c")));
}

TEST(FairShares, TheNetworksOfOneSiteLeaveAQuarterToOtherSites) {
  FairShares shares(128);
  std::size_t ofSite = 0;
  for (int i = 0; i < 1'000; ++i) {
    ofSite += takenBy(shares, {"2001:db8:0:" + std::to_string(i) + "::/64", "2001:db8::/48"});
  }
  EXPECT_EQ(ofSite, 96u);
  EXPECT_EQ(takenBy(shares, alone("192.0.2.1")), 16u);
}

TEST(FairShares, AnOperatorsBoundReplacesTheShare) {
  FairShares shares(8, 8);
  EXPECT_EQ(takenBy(shares, alone("proxy")), 8u);
  FairShares few(8, 2);
  EXPECT_EQ(takenBy(few, alone("a")), 2u);
}

TEST(FairShares, APlaceIsGivenBackWithItsLastCopy) {
  FairShares shares(1);
  auto place = shares.place(alone("a"));
  ASSERT_TRUE(place);
  EXPECT_FALSE(shares.place(alone("b")));
  place.reset();
  EXPECT_TRUE(shares.place(alone("b")));
}

} // namespace
} // namespace gnomon

#include "server/system/fair_shares.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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

TEST(FairShares, WhatHasNoneMayTakeAllThatIsLeft) {
  EXPECT_TRUE(mayTake({.capacity = 100}, 100, Share::half));
  EXPECT_FALSE(mayTake({.capacity = 100}, 101, Share::half));
  EXPECT_TRUE(mayTake({.capacity = 100, .taken = 90}, 10, Share::threeQuarters));
  EXPECT_FALSE(mayTake({.capacity = 100, .taken = 90}, 11, Share::threeQuarters));
  EXPECT_FALSE(mayTake({.capacity = 100, .taken = 120}, 1, Share::half)) << "a capacity that has become less";
}

RC_GTEST_PROP(FairShares, AClientsShareIsOfWhatOthersLeave, ()) {
  const std::uint64_t capacity = *rc::gen::inRange(1, 1'000), taken = *rc::gen::inRange<std::uint64_t>(0, capacity + 1);
  const std::uint64_t bySite = *rc::gen::inRange<std::uint64_t>(0, taken + 1);
  const std::uint64_t byClient = *rc::gen::inRange<std::uint64_t>(0, bySite + 1);
  const std::uint64_t more = *rc::gen::inRange<std::uint64_t>(1, capacity + 1);
  const SharedUse use{capacity, taken, byClient, bySite};
  if (!mayTake(use, more, Share::half)) {
    RC_ASSERT(more + 1 > capacity || !mayTake(use, more + 1, Share::half)); // nor may it take one more
    return;
  }
  RC_ASSERT(taken + more <= capacity);
  RC_ASSERT(byClient == 0 || 2 * (byClient + more) <= capacity - (taken - byClient));
  RC_ASSERT(bySite == 0 || 4 * (bySite + more) <= 3 * (capacity - (taken - bySite)));
  RC_ASSERT(mayTake(use, more, Share::threeQuarters));
  RC_ASSERT(mayTake({capacity, taken - bySite, 0, 0}, more, Share::half)); // were all of its own given back
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

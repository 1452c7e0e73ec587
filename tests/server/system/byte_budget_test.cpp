#include "server/system/byte_budget.h"

#include <gtest/gtest.h>
#include <thread>

namespace gnomon {
namespace {

using namespace std::chrono_literals;

Holder of(const std::string& client, const std::string& request = "1") {
  return {{client, client}, request};
}

Holder inSite(const std::string& client, const std::string& site) {
  return {{client, site}, client};
}

TEST(ByteBudget, OneRequestMayHoldAllOfIt) {
  ByteBudget budget(100);
  ByteLease lease(budget, of("a"));
  EXPECT_TRUE(lease.grow(60));
  EXPECT_TRUE(lease.grow(40));
  EXPECT_FALSE(lease.grow(1));
  EXPECT_EQ(budget.used(), 100u);
  lease.shrinkTo(0);
  EXPECT_EQ(budget.used(), 0u);
}

TEST(ByteBudget, RequestsOfOneClientLeaveAQuarterToOthers) {
  ByteBudget budget(100);
  ByteLease first(budget, of("a", "1")), second(budget, of("a", "2")), other(budget, of("b"));
  ASSERT_TRUE(first.grow(40));
  EXPECT_FALSE(second.grow(36));
  EXPECT_TRUE(second.grow(35));
  EXPECT_FALSE(second.grow(1)) << "however it comes to it";
  EXPECT_TRUE(other.grow(25));
}

TEST(ByteBudget, AShareIsOneOfWhatOthersLeave) {
  ByteBudget budget(10'000);
  std::vector<std::unique_ptr<ByteLease>> leases;
  for (const char* client : {"a", "b", "c", "d", "e"}) {
    std::size_t held = 0;
    for (int request = 0; request < 1000; ++request) {
      leases.push_back(std::make_unique<ByteLease>(budget, of(client, std::to_string(request))));
      held += leases.back()->grow(10) ? 10u : 0u;
    }
    EXPECT_GT(held, 0u) << client;
    EXPECT_LT(budget.used(), budget.total()) << client;
  }
}

TEST(ByteBudget, ClientsOfOneSiteShareLikeOne) {
  ByteBudget budget(100);
  std::vector<std::unique_ptr<ByteLease>> leases;
  for (int i = 0; i < 100; ++i) {
    leases.push_back(std::make_unique<ByteLease>(budget, inSite("2001:db8:0:" + std::to_string(i) + "::/64", "site")));
    leases.back()->grow(1);
  }
  EXPECT_EQ(budget.used(), 75u);
}

TEST(ByteBudget, WhatNoClientHoldsHasNoShare) {
  ByteBudget budget(100);
  ByteLease first(budget), second(budget);
  EXPECT_TRUE(first.grow(50));
  EXPECT_TRUE(second.grow(50));
}

TEST(ByteBudget, SaysBeforehandWhetherThereIsRoom) {
  ByteBudget budget(100);
  ByteLease first(budget, of("a"));
  ASSERT_TRUE(first.grow(50));
  EXPECT_TRUE(budget.hasRoom(of("a"), 25));
  EXPECT_FALSE(budget.hasRoom(of("a"), 26));
  EXPECT_TRUE(budget.hasRoom(of("b"), 50));
  EXPECT_FALSE(budget.hasRoom(of("b"), 51));
}

TEST(ByteBudget, NobodyHurriesUntilAnotherClientWaits) {
  ByteBudget budget(6000);
  ByteLease lease(budget, of("a"));
  ASSERT_TRUE(lease.grow(6000));
  EXPECT_EQ(budget.hurry(of("a")), 0u);
  ByteLease own(budget, of("a", "2"));
  EXPECT_FALSE(own.grow(10));
  EXPECT_EQ(budget.hurry(of("a")), 0u) << "a client waits for itself";
  ByteLease other(budget, of("b"));
  EXPECT_FALSE(other.grow(10));
  EXPECT_EQ(budget.hurry(of("a")), 100u) << "all of it in 60 s";
  EXPECT_EQ(budget.hurry(of("b")), 0u);
  lease.shrinkTo(5990);
  EXPECT_EQ(budget.hurry(of("a")), 0u) << "there is room for the other";
}

TEST(ByteBudget, WhoHoldsLessNeedNotHurry) {
  ByteBudget budget(6000);
  ByteLease much(budget, of("a")), less(budget, of("b")), waiting(budget, of("c"));
  ASSERT_TRUE(much.grow(3600));
  ASSERT_TRUE(less.grow(2400));
  EXPECT_FALSE(waiting.grow(60));
  EXPECT_EQ(budget.hurry(of("a")), 60u);
  EXPECT_EQ(budget.hurry(of("b")), 0u);
}

TEST(ByteBudget, ManyRequestsCountTogetherAndHurryByTheirOwnSize) {
  ByteBudget budget(6000);
  ByteLease one(budget, of("a", "1")), two(budget, of("a", "2")), alone(budget, of("b")), waiting(budget, of("c"));
  ASSERT_TRUE(one.grow(1800));
  ASSERT_TRUE(two.grow(1800));
  ASSERT_TRUE(alone.grow(2400));
  EXPECT_FALSE(waiting.grow(60));
  EXPECT_EQ(budget.hurry(of("a", "1")), 30u);
  EXPECT_EQ(budget.hurry(of("b")), 0u);
}

TEST(ByteBudget, AClientWaitsUntilItIsServedOrShouldHaveComeAgain) {
  ByteBudget budget(6000);
  ByteLease lease(budget, of("a")), other(budget, of("b"));
  ASSERT_TRUE(lease.grow(6000));
  EXPECT_FALSE(other.grow(10));
  const auto comes = Clock::now() + std::chrono::seconds(budget.retryAfterSeconds());
  EXPECT_GT(budget.hurry(of("a"), comes + 1s), 0u);
  EXPECT_EQ(budget.hurry(of("a"), comes + 1min), 0u);
  lease.shrinkTo(5000);
  EXPECT_TRUE(other.grow(10));
  EXPECT_TRUE(lease.grow(990));
  EXPECT_EQ(budget.hurry(of("a")), 0u);
}

TEST(ByteBudget, AnUploadWaitsForAllThatItAnnounced) {
  ByteBudget budget(6000);
  ByteLease lease(budget, of("a"));
  {
    ByteLease upload(budget, of("b"), 3000);
    ASSERT_TRUE(upload.grow(1000));
    ASSERT_TRUE(lease.grow(5000));
    EXPECT_FALSE(upload.grow(1000));
  }
  EXPECT_EQ(budget.used(), 5000u);
  EXPECT_GT(budget.hurry(of("a")), 0u) << "what it gave back is not enough for it";
}

TEST(ByteBudget, EndsOneAtATime) {
  ByteBudget budget(100);
  const auto now = Clock::now();
  EXPECT_TRUE(budget.mayEndOne(now));
  EXPECT_FALSE(budget.mayEndOne(now + 500ms));
  EXPECT_TRUE(budget.mayEndOne(now + 1500ms));
}

TEST(ByteBudget, ComeAgainWhenTheOldestShouldBeDone) {
  ByteBudget budget(100);
  EXPECT_EQ(budget.retryAfterSeconds(), 10);
  ByteLease lease(budget, of("a"));
  ASSERT_TRUE(lease.grow(100));
  EXPECT_EQ(budget.retryAfterSeconds(Clock::now() + 55s), 5);
  EXPECT_EQ(budget.retryAfterSeconds(Clock::now() + 90s), 1);
}

TEST(ByteBudget, OneThatWaitsIsServedOnceThereIsRoom) {
  ByteBudget budget(100);
  ByteLease lease(budget, of("a"));
  ASSERT_TRUE(lease.grow(100));
  std::thread holder([&] {
    std::this_thread::sleep_for(20ms);
    lease.shrinkTo(50);
  });
  ByteLease other(budget, of("b"));
  EXPECT_TRUE(other.growBy(50, Clock::now() + 1h));
  holder.join();
}

} // namespace
} // namespace gnomon

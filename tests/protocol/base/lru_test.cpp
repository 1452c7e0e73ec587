#include "protocol/base/lru.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <string>
#include <vector>

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

struct Named {
  std::string name;
  std::size_t cost = 1;
};

std::vector<std::string> namesOf(const LruList<Named>& list) {
  std::vector<std::string> names;
  for (const Named& each : list) names.push_back(each.name);
  return names;
}

LruList<Named> cba() {
  LruList<Named> list;
  for (const char* name : {"a", "b", "c"}) list.add({name});
  return list;
}

TEST(LruList, WhatIsFoundIsTheMostRecentlyUsed) {
  auto list = cba();
  EXPECT_THAT(namesOf(list), ElementsAre("c", "b", "a"));
  const Named* const a = list.find("a", &Named::name);
  ASSERT_NE(a, nullptr);
  EXPECT_EQ(a->name, "a");
  EXPECT_THAT(namesOf(list), ElementsAre("a", "c", "b"));
  EXPECT_EQ(list.findIf([](const Named& each) { return each.name > "a"; })->name, "c");
  EXPECT_THAT(namesOf(list), ElementsAre("c", "a", "b"));
  EXPECT_EQ(list.find("d", &Named::name), nullptr);
  EXPECT_THAT(namesOf(list), ElementsAre("c", "a", "b"));
}

TEST(LruList, EntriesStayWhereTheyAre) {
  auto list = cba();
  const Named* const a = list.find("a", &Named::name);
  list.find("b", &Named::name);
  list.add({"d"});
  list.eraseIf([](const Named& each) { return each.name == "c"; });
  EXPECT_EQ(list.find("a", &Named::name), a);
}

TEST(LruList, TheNewestOfTwoWithOneKeyIsFound) {
  auto list = cba();
  list.add({"a", 7});
  EXPECT_EQ(list.find("a", &Named::name)->cost, 7u);
  EXPECT_EQ(list.eraseIf([](const Named& each) { return each.name == "a"; }), 2u);
  EXPECT_THAT(namesOf(list), ElementsAre("c", "b"));
}

TEST(LruList, ANumberOrNoneIsKept) {
  auto list = cba();
  list.keepNewest(3);
  EXPECT_EQ(list.size(), 3u);
  list.keepNewest(2);
  EXPECT_THAT(namesOf(list), ElementsAre("c", "b"));
  list.keepNewest(0);
  EXPECT_THAT(namesOf(list), IsEmpty());
  list.keepNewest(0);
}

TEST(LruList, TheNewestStaysWhateverItCosts) {
  auto list = cba();
  list.add({"large", 100});
  list.keepWithin(3, [](const Named& each) { return each.cost; });
  EXPECT_THAT(namesOf(list), ElementsAre("large"));
}

TEST(LruList, WhatIsSharedCanBeCountedOnce) {
  auto list = cba();
  std::size_t asked = 0;
  list.keepWithin(5, [&asked](const Named&) { return asked++ == 0 ? 4u : 1u; });
  EXPECT_THAT(namesOf(list), ElementsAre("c", "b"));
}

TEST(LruList, KeepsWhatAPlainModelKeeps) {
  EXPECT_TRUE(rc::check("the last used within the budget", [](const std::vector<std::pair<unsigned char, bool>>& uses) {
    constexpr std::size_t kBudget = 20, kMost = 6;
    const auto costOf = [](int key) { return static_cast<std::size_t>(key % 7); };
    LruList<int> list;
    std::vector<int> model; // the oldest first
    for (const auto& [number, isOnlyAsked] : uses) {
      const int key = number % 16;
      const bool known = std::erase(model, key) > 0;
      if (known || !isOnlyAsked) model.push_back(key);
      RC_ASSERT((list.find(key, std::identity()) != nullptr) == known);
      if (known || isOnlyAsked) continue;
      list.add(key);
      list.keepNewest(kMost);
      list.keepWithin(kBudget, costOf);
      const auto cost = [&] {
        std::size_t sum = 0;
        for (const int each : model) sum += costOf(each);
        return sum;
      };
      while (model.size() > kMost || (model.size() > 1 && cost() > kBudget)) model.erase(model.begin());
      RC_ASSERT(std::vector<int>(list.begin(), list.end()) == std::vector<int>(model.rbegin(), model.rend()));
    }
  }));
}

} // namespace
} // namespace gnomon

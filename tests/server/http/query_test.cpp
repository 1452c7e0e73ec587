#include "server/http/query.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

std::vector<std::string> pointersOf(const Problems& problems) {
  std::vector<std::string> pointers;
  for (const Problem& problem : problems) pointers.push_back(problem.pointer);
  return pointers;
}

TEST(QueryKeys, RefusesWhatIsNotAmongThem) {
  const QueryKeys keys{"limit", "after"};
  EXPECT_TRUE(keys.check({}).empty());
  EXPECT_TRUE(keys.check({{"after", ""}, {"limit", "x"}}).empty()) << "values are the route's";
  const Problems problems = keys.check({{"Limit", "1"}, {"after", "1"}, {"", "2"}, {"after", "3"}});
  EXPECT_EQ(pointersOf(problems), (std::vector<std::string>{"/Limit", "/", "/after"}));
  EXPECT_EQ(problems.at(0).limit, "limit, after");
  EXPECT_EQ(QueryKeys().check({{"v", "1"}}).at(0).limit, "no query");
  EXPECT_TRUE(QueryKeys::any().check({{"v", "1"}, {"v", "2"}}).empty());
}

TEST(QueryKeys, ItsProblemsAreFewerThanAHostileQuerysKeys) {
  EXPECT_EQ(QueryKeys().check(Query(10'000, {"x", ""})).size(), ProblemList::kMax + 1);
}

TEST(Query, GivesAKeysTextOrNothing) {
  const Query query{{"a", "1"}, {"b", ""}};
  EXPECT_EQ(queryText(query, "a"), "1");
  EXPECT_EQ(queryText(query, "b"), "");
  EXPECT_EQ(queryText(query, "c"), std::nullopt);
}

TEST(Query, ANumberIsDigitsWithinItsRange) {
  const auto asked = [](const char* text) { return queryNumber({{"n", text}}, "n", 1, 20, "This is no n."); };
  EXPECT_EQ(*asked("1"), 1);
  EXPECT_EQ(*asked("20"), 20);
  EXPECT_EQ(*queryNumber({{"m", "1"}}, "n", 1, 20, ""), std::nullopt);
  for (const char* wrong : {"", "0", "21", "-1", "+1", " 1", "1 ", "1.0", "0x1", "99999999999999999999", "one"}) {
    const auto refused = asked(wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.problems()[0].pointer, "/n");
    EXPECT_EQ(refused.problems()[0].detail, "This is no n.");
    EXPECT_EQ(refused.problems()[0].limit, "1..20");
    EXPECT_EQ(refused.problems()[0].actual, wrong);
  }
}

} // namespace
} // namespace gnomon

#include "protocol/base/result.h"

#include <gtest/gtest.h>
#include <memory>

#include "protocol/base/json.h"

namespace gnomon {
namespace {

Result<int> half(int value) {
  if (value % 2 != 0) return Problem{.code = ProblemCode::invalidValue, .pointer = "/value", .detail = "Odd."};
  return value / 2;
}

TEST(Result, HoldsAValue) {
  const Result<int> result = half(8);
  ASSERT_TRUE(result);
  EXPECT_EQ(*result, 4);
}

TEST(Result, HoldsOneProblem) {
  const Result<int> result = half(7);
  ASSERT_FALSE(result);
  ASSERT_EQ(result.problems().size(), 1u);
  EXPECT_EQ(result.problems()[0].code, ProblemCode::invalidValue);
  EXPECT_EQ(result.problems()[0].pointer, "/value");
}

TEST(Result, HoldsSeveralProblemsInOrder) {
  const Result<int> result = Problems{{.pointer = "/a"}, {.pointer = "/b"}};
  ASSERT_FALSE(result);
  ASSERT_EQ(result.problems().size(), 2u);
  EXPECT_EQ(result.problems()[1].pointer, "/b");
}

TEST(Result, ThereIsAlwaysAReason) {
  const Result<int> result = Problems{};
  ASSERT_FALSE(result);
  ASSERT_EQ(result.problems().size(), 1u);
  EXPECT_EQ(result.problems()[0].code, ProblemCode::internal);
  EXPECT_FALSE(result.problems()[0].detail.empty());
  EXPECT_EQ(atLeastOne({{.pointer = "/a"}}).front().pointer, "/a");
}

TEST(Result, MemoryThatWasNotGivenIsNoLimitThatWasPassed) {
  EXPECT_TRUE(isNoMemory(noMemory("/images/3", "No memory.")));
  EXPECT_FALSE(isNoMemory({ProblemCode::tooLarge, "/width", "Too wide.", "1..16384"}));
  EXPECT_FALSE(isNoMemory({ProblemCode::unavailable, "", "Away."}));
}

TEST(Result, TheValueCanBeMovedOutAndChanged) {
  Result<std::unique_ptr<int>> result = std::make_unique<int>(3);
  ASSERT_TRUE(result);
  **result = 5;
  const std::unique_ptr<int> value = *std::move(result);
  EXPECT_EQ(*value, 5);
}

TEST(Result, TheArrowReachesTheValue) {
  Result<std::string> result = std::string("abc");
  result->append("d");
  EXPECT_EQ(result->size(), 4u);
}

TEST(Result, ProblemsCanBeMovedIntoAResultOfAnotherType) {
  Result<int> first = half(1);
  const Result<std::string> second = std::move(first).problems();
  ASSERT_FALSE(second);
  EXPECT_EQ(second.problems()[0].detail, "Odd.");
}

TEST(Result, AnActionIsDoneOrNot) {
  const Status done = Done{};
  const Status failed = Problem{};
  EXPECT_TRUE(done);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.problems()[0].code, ProblemCode::internal);
}

TEST(Place, WritesAPointer) {
  const Place root;
  const Place lights(root, "lights");
  const Place second(lights, std::size_t{1});
  EXPECT_EQ(root.pointer(), "");
  EXPECT_EQ(Place(second, "sun").pointer(), "/lights/1/sun");
}

TEST(Place, EscapesAsRfc6901Has) {
  EXPECT_EQ(Place(Place(), "a/b~c").pointer(), "/a~1b~0c");
  EXPECT_EQ(Place(Place(), "").pointer(), "/");
}

TEST(Place, ATokenIsEscapedAndWhole) {
  EXPECT_EQ(escapedToken("~/plain~1"), "~0~1plain~01");
  EXPECT_EQ(escapedToken(std::string(1000, 'k')).size(), 1000u);
}

TEST(Place, ShortensAVeryLongKey) {
  const std::string key(100'000, 'k');
  EXPECT_LE(Place(Place(), key).pointer().size(), 101u);
}

TEST(Place, KnowsWhatLiesWithin) {
  EXPECT_TRUE(pointsInto("/camera/eye/0", "/camera"));
  EXPECT_TRUE(pointsInto("/camera", "/camera"));
  EXPECT_TRUE(pointsInto("/camera", ""));
  EXPECT_FALSE(pointsInto("/camera", "/camera/eye"));
  EXPECT_FALSE(pointsInto("/cameras", "/camera"));
}

TEST(JsonShape, FindsTheBracketThatIsTooDeep) {
  EXPECT_FALSE(findExcess("[[1], {\"a\": []}]", {3}));
  const auto excess = findExcess("[[1], {\"a\": []}]", {2});
  ASSERT_TRUE(excess);
  EXPECT_EQ(excess->of, JsonExcess::Of::depth);
  EXPECT_EQ(excess->offset, 12u);
}

TEST(JsonShape, CountsValues) {
  EXPECT_FALSE(findExcess("[1,2,3]", {1, 4}));
  const auto excess = findExcess("[1,2,3]", {1, 3});
  ASSERT_TRUE(excess);
  EXPECT_EQ(excess->of, JsonExcess::Of::values);
  EXPECT_EQ(excess->offset, 4u);
}

TEST(JsonShape, StringsAreNoBrackets) {
  EXPECT_FALSE(findExcess(R"("[[[,,,\"[[[\\")", {0, 1}));
  EXPECT_FALSE(findExcess(R"("ends in an escape \)", {0, 1}));
}

TEST(JsonShape, TakesWhatIsNoJson) {
  EXPECT_FALSE(findExcess("", {0}));
  EXPECT_FALSE(findExcess("]]]}}}[", {1}));
}

} // namespace
} // namespace gnomon

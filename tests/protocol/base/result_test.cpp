#include "protocol/base/result.h"

#include <gtest/gtest.h>
#include <memory>

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

} // namespace
} // namespace gnomon

#include "protocol/base/json_shape.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

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

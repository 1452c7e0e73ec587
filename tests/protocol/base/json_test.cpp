#include "protocol/base/json.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

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

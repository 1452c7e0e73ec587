#include "protocol/base/json_pointer.h"

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

} // namespace
} // namespace gnomon

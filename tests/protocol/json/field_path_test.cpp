#include "protocol/json/field_path.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon {
namespace {

using Steps = std::vector<FieldStep>;

TEST(FieldPath, HasIndicesInBrackets) {
  EXPECT_EQ(*fieldSteps("lights[0].sun.azimuthDegrees"), (Steps{"lights", std::size_t{0}, "sun", "azimuthDegrees"}));
  EXPECT_EQ(*fieldSteps("a[1][20]"), (Steps{"a", std::size_t{1}, std::size_t{20}}));
  EXPECT_EQ(*fieldSteps("lights.0.type"), *fieldSteps("lights[0].type"));
  EXPECT_EQ(*fieldSteps("width"), (Steps{"width"}));
  EXPECT_EQ(*fieldSteps("a..b"), (Steps{"a", "", "b"}));
}

TEST(FieldPath, OtherBracketsAreProblems) {
  for (const char* path : {"lights[]", "lights[", "lights]", "lights[-1]", "lights[1.5]", "lights[0]x", "[0]", "a.[0]",
                           "lights[0", "lights[1000000000]", "lights[ 1]", "lights[+1]"}) {
    ASSERT_FALSE(fieldSteps(path)) << path;
    EXPECT_EQ(fieldSteps(path).problems()[0].limit, "as lights[0].type") << path;
  }
}

TEST(FieldPath, IsThatOfItsPointer) {
  EXPECT_EQ(pointerOf(*fieldSteps("lights[2].shadow.size")), "/lights/2/shadow/size");
  EXPECT_EQ(fieldPath("/lights/2/shadow/size"), "lights[2].shadow.size");
  EXPECT_EQ(fieldPath(""), "");
}

RC_GTEST_PROP(FieldPath, ComesBackFromItsPointer, ()) {
  std::string path = "a";
  for (const bool isIndex : *rc::gen::arbitrary<std::vector<bool>>()) {
    path += isIndex ? "[" + std::to_string(*rc::gen::inRange(0, 1000)) + "]" : ".b";
  }
  RC_ASSERT(fieldPath(pointerOf(*fieldSteps(path))) == path);
}

} // namespace
} // namespace gnomon
